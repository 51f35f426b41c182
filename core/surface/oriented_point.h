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
  bool normal_told = false;   ///< it says more of the surface than the points round it do
  bool surely_noise = false;  ///< the variance is none of shape
};

/// Whether noise, a variance, is so little beside the distance between points that it is not worth
/// smoothing. What bends at the points' own scale, as the facets of a mesh do, looks like noise and
/// must not be smoothed: of exact points on scanned feet girths were 0.17 mm short in place of
/// 0.05. Noise that is surely some lengthens lines through points, though, as few may come to lie
/// much nearer to each other than as a rule: of random points, by a part in 1,000 where it is a
/// hundredth of the spacing, by 3 in 100,000 where it is a thousandth.
inline bool is_harmless(double noise, double spacing, bool surely_noise) {
  constexpr double kHarmlessIfShape = 0.01;
  constexpr double kHarmless = 0.0005;
  const double most = (surely_noise ? kHarmless : kHarmlessIfShape) * spacing;
  return noise <= most * most;
}

inline bool is_harmless(const OrientedPoint& point, double spacing) {
  return is_harmless(point.variance, spacing, point.surely_noise);
}

inline bool all_tell_normals(const std::vector<OrientedPoint>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const OrientedPoint& point) { return point.normal_told; });
}

}  // namespace instep
