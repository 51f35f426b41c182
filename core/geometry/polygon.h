#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The convex hull of points in the plane, counter-clockwise, without the points inside its edges
/// (Andrew's monotone chain). Fewer than three points come back as they are, sorted and without
/// duplicates. Coordinates must be finite. O(n log n).
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

/// Length round a closed polygon whose first point is not repeated; twice the length for two
/// points, zero for fewer.
double perimeter(const std::vector<Eigen::Vector2d>& polygon);

/// Area of a closed polygon, positive if it runs counter-clockwise.
double signed_area(const std::vector<Eigen::Vector2d>& polygon);

/// True if a polygon is more than a line or a point: it encloses more than a millionth of the
/// square of its length. Of many points give the hull.
bool is_ring(const std::vector<Eigen::Vector2d>& polygon);

/// How far inside a convex polygon that runs counter-clockwise a point lies, in its unit: the least
/// distance from the lines through its edges, negative outside of any. Outside of a corner that is
/// less than the way to it. The polygon's corners differ; without any a point is infinitely deep.
/// O(corners).
double depth_in(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& point);

/// A place on the line round a closed polygon.
struct BorderPlace {
  double way = 0.0;       ///< along it from the first corner
  double distance = 0.0;  ///< from the point that was asked for
};

/// The nearest to a point, the first of equally near ones; infinitely far where there are no
/// corners. O(corners).
BorderPlace nearest_on_border(const std::vector<Eigen::Vector2d>& polygon,
                              const Eigen::Vector2d& point);

/// The part of a closed polygon where `inward` . p >= `level`, the cut edges joined by straight
/// lines (Sutherland and Hodgman). Empty if nothing is left.
std::vector<Eigen::Vector2d> clipped(const std::vector<Eigen::Vector2d>& polygon,
                                     const Eigen::Vector2d& inward, double level);

}  // namespace instep
