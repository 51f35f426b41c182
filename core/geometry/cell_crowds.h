#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// Points by the cubic cells that they lie in.
struct CellCrowds {
  /// Which points share a cell with one that is nearer to the cell's middle, of equally near ones
  /// with an earlier one. Without them a crowd is as dense as the cells are, and more even; points
  /// that stand further apart all stay.
  std::vector<bool> crowding;
  std::vector<std::size_t> counts;  ///< of points, for each cell that has some

  /// Whether a cell holds many times as many as three quarters of them do: the one nearest to its
  /// middle need not lie on the skin then.
  bool has_pile() const;
};

/// `points` in the order of their first coordinate, all finite; `side` > 0: of a cell. Cells are
/// counted from the least coordinates. O(n log m) for the m in one layer of cells.
CellCrowds crowds_in_cells(const std::vector<Eigen::Vector3d>& points, double side);

}  // namespace instep
