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

/// Whether noise, a variance, is so little beside the distance between points that it is not worth
/// smoothing: taken for shape it lengthens no line along them by more than a part in 10,000. What
/// bends at the points' own scale, as the facets of a mesh do, looks like such noise and must not
/// be smoothed: of exact points on scanned feet girths were 0.17 mm short in place of 0.05.
inline bool is_harmless(double noise, double spacing) {
  constexpr double kHarmless = 0.01;
  return noise <= kHarmless * kHarmless * spacing * spacing;
}

inline bool all_tell_normals(const std::vector<OrientedPoint>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const OrientedPoint& point) { return point.normal_told; });
}

}  // namespace instep
