#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/fitted_plane.h"

namespace instep {

/// The two walls of a thin part, such as a fin, a slit or the tip of a wedge, told apart by where
/// points lie that show both: one plane through all of them would run between the walls. Seen from
/// a tape plane: the third axis is square to it.
struct OppositeWalls {
  std::array<FittedPlane, 2> both;
  std::vector<std::uint8_t> sides;  ///< of each point, 0 or 1

  /// Nothing if two planes do not explain the points ten times as well as one does (in squares),
  /// and few points better than that, if they turn by more than 60 degrees, if they lie beside each
  /// other as those of a roof do and not over each other, if they face along the third axis, as two
  /// rows do that lie level, or if one has fewer than six points, or these lie on a line.
  /// O(points), or where there may be two walls up to 256 times as much.
  static std::optional<OppositeWalls> among(const std::vector<Eigen::Vector3d>& points);
};

}  // namespace instep
