#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/rigid_transform.h"

namespace instep {

/// Mean and covariance of points in space: the paper's eq. 3, with its division by N - 1.
struct PointSpread {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of at least one point; the covariance of a single one is zero. Two passes, so that a cloud far
/// from the origin loses no digits. O(n).
PointSpread spread_of(const std::vector<Eigen::Vector3d>& points);

/// The frame of the principal components (the paper, section 3.1): origin in the mean, x along the
/// largest variance, z along the smallest, right-handed. Of a band round a body, z is about the
/// normal of the tape plane.
///
/// The paper leaves the signs open: here the largest component of x, and of y, is positive in the
/// input's frame. Where two variances are equal, as round a cylinder, the axes between them are
/// arbitrary, but the same for the same points. At least one point. O(n).
RigidTransform principal_from_input(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
