#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep {

/// Rows that the points of a sheet lie on, such as those of a lattice or the lines of a scanner.
struct SheetRows {
  std::size_t count = 0;
  double apart = 0.0;  ///< from row to row, on average
};

/// Rows that lead nearly `along` (unit length, within 0.2 radians), a direction of the sheet that
/// faces `outward`. Nothing if the points lie on more than a fifth as many rows as there are
/// points, as those at random do. At least one point. O(points log points).
std::optional<SheetRows> rows_along(const std::vector<OrientedPoint>& points,
                                    const Eigen::Vector3d& along, const Eigen::Vector3d& outward);

}  // namespace instep
