#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The sides of a rectangle that turns freely in the plane.
struct RectangleSides {
  double length = 0.0;  ///< the longer one
  double width = 0.0;
};

/// Sides of the rectangle of least area round a convex polygon, as convex_hull() gives it: one of
/// its sides lies on an edge of the polygon (Freeman and Shapira 1975). Zero for fewer than two
/// points. O(edges * corners).
RectangleSides enclosing_rectangle(const std::vector<Eigen::Vector2d>& hull);

}  // namespace instep
