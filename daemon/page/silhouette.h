#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace instep {

/// Cells of a square grid, as row and column.
using GridCell = std::pair<int, int>;

/// The outlines of a set of cells, holes among them, as smooth closed lines: in units of a cell,
/// x along the columns, with the middle of cell (0, 0) at (0, 0). They run through the middles of
/// the outermost cells, since a body ends somewhere in them. What is a cell or two wide vanishes.
std::vector<std::vector<Eigen::Vector2d>> silhouette(const std::vector<GridCell>& cells);

}  // namespace instep
