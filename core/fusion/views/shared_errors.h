#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/geometry/rigid_transform.h"

namespace instep {

/// An error that all points of a view share, as what is left unknown of its pose and its lens.
/// Unlike the noise of the points it does not average out round a section.
///
/// A cloud is told no more of them.
inline constexpr std::size_t kMostSharedErrors = 200;

/// How it moves the points of a view, one sigma: a point at (x, 1) by field * (x, 1).
using ErrorField = Eigen::Matrix<double, 3, 4>;

/// The errors of one view, in its camera's frame. The first of one view and the first of another
/// one are the same error of all views, and so on; different ones are independent. A view without
/// any is taken to have none.
struct ViewErrors {
  std::vector<ErrorField> fields;
  RigidTransform station_from_camera = RigidTransform::Identity();
};

/// The same field, of points and displacements in another frame.
ErrorField in_frame(const RigidTransform& target_from_source, const ErrorField& field);

/// What these errors do to a cloud in the station frame, with normals: PointCloud::shared_errors_mm
/// of its points, as the few errors that leave less than a hundredth of their variance untold, at
/// most kMostSharedErrors, each point's variance weighing the same. What moves all views together
/// as one rigid body, each by its share, is none: no shape knows of it. `shares`: how much each
/// view (row) counts in each point (column), one row a view. Some 3 ms for 40,000 points of four
/// views.
std::vector<std::vector<double>> shared_errors_of(const PointCloud& cloud,
                                                  const Eigen::MatrixXd& shares,
                                                  const std::vector<ViewErrors>& views);

}  // namespace instep
