#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace instep {

/// Value and gradient of a field at one place.
struct FieldValue {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// A point of a surface with a unit normal that points out of the body, and how far it may lie
/// from the true surface (variance along the normal).
struct OrientedPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double variance = 0.0;
  bool normal_told = false;  ///< it says more of the surface than the points round it do
};

inline bool all_tell_normals(const std::vector<OrientedPoint>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const OrientedPoint& point) { return point.normal_told; });
}

}  // namespace instep
