#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Points round a place, seen along the normal of their own tangent plane: columns are points, seen
/// from their middle, the third row is the height.
struct TangentView {
  Eigen::Matrix3Xd points;
  std::vector<std::size_t> indices;                            ///< of each point, in the PointIndex
  double thickness = std::numeric_limits<double>::infinity();  ///< against the width
  /// The 60 nearest points, whatever of them is in view, reach so little that a crease or a bend
  /// among them does not pass for noise.
  bool crowded = false;

  double radius() const { return points.size() > 0 ? points.colwise().norm().maxCoeff() : 0.0; }
  /// Between points, as evenly spread as they may be.
  double spacing() const;
};

/// Of the points nearest to `centre` as many as look flat, up to kMostInView of them, evenly chosen
/// by their distance from it, in a unit in which the body is about one long: more where noise is
/// thicker than the spacing, fewer where the surface bends much. Of a thin part those on one of its
/// walls, unless that faces the middle of the body (the origin) or away from it: there may be two
/// layers of one skin. Where no count looks flat, the flattest.
TangentView flattest_view(const PointIndex& index, const Eigen::Vector3d& centre);

/// What is read off a view costs the cube of this.
inline constexpr std::size_t kMostInView = 60;

}  // namespace instep
