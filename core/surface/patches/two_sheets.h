#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/fitted_plane.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// Points of two sheets that meet in an angle, parted by which of them they lie on: the body is
/// what lies under both (a convex crease) or under either.
struct TwoSheets {
  /// Through the middle of the points on either side; each faces as these do.
  std::array<FittedPlane, 2> planes;
  std::vector<std::uint8_t> sides;  ///< of each point, 0 or 1
  bool convex = true;

  /// Angle between the planes, in radians.
  double turn() const;

  std::array<std::vector<std::size_t>, 2> members() const;
  std::array<std::vector<OrientedPoint>, 2> parted(const std::vector<OrientedPoint>& points) const;

  /// By the sheet that faces as their told normals do. Nothing if one has fewer than six, or if
  /// they turn by less than kLeastTurnOfToldPlanes (crease_rule.h). O(points).
  static std::optional<TwoSheets> by_told_normals(const std::vector<OrientedPoint>& points);

  /// By the plane that bounds the body where they are. Nothing if one has fewer than six, or as
  /// soon as the planes turn by less than kLeastTurnOfPlanes, as those of a smooth bend do from the
  /// first. O(points).
  static std::optional<TwoSheets> by_planes(const std::vector<OrientedPoint>& points);

  /// Anew, by the quadratic that bounds the body where they are: the planes of sheets that bend
  /// towards the crease put some of the points by it on the wrong one. Noise by the crease would
  /// part them as well: for points that scatter little. The planes stay: the quadratics, and the
  /// patches after them, are heights over these. O(points).
  void part_by_quadratics(const std::vector<OrientedPoint>& points, const Eigen::Vector3d& centre,
                          double radius);
};

}  // namespace instep
