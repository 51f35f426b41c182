#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/extent.h"

namespace instep {

/// Where a surface that reaches to infinity has to end, since the points do (the paper, section
/// 3.4, figure 3): a place counts only if, along each of the three axes, it lies between the
/// outermost points of a cylinder through it. The cylinder's radius is at first the longest edge of
/// the minimum spanning tree and is doubled until a tenth of all points lie within.
///
/// Read-only once built, in O(n log n). Coordinates must be finite.
class CylinderRule {
 public:
  /// At least one point, in their principal frame; `first_radius` > 0.
  CylinderRule(const std::vector<Eigen::Vector3d>& points, double first_radius);

  /// What the cylinder along `axis` (0, 1, 2: x, y, z) through a place admits; the place's own
  /// coordinate along that axis does not matter. Points are seen along the axis in square tiles,
  /// and only those of the tiles that the circle cuts are looked at one by one.
  Extent range(Eigen::Index axis, const Eigen::Vector3d& place) const;

 private:
  /// The points that lie on one tile, seen along an axis, and their range along it.
  struct Tile {
    std::vector<Eigen::Vector3d> points;
    Extent range = Extent::none();
  };

  /// All tiles, row by row.
  struct View {
    Eigen::Vector2d corner;
    double side = 1.0;
    Eigen::Vector2i counts;
    std::vector<Tile> tiles;
  };

  struct Content {
    std::size_t points = 0;
    Extent range = Extent::none();
  };

  static View view_along(Eigen::Index axis, const std::vector<Eigen::Vector3d>& points);
  static Content content(const View& view, Eigen::Index axis, const Eigen::Vector2d& centre,
                         double radius);

  std::size_t count_;
  double first_radius_;
  std::array<View, 3> views_;
};

}  // namespace instep
