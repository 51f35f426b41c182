#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// Which points share a cubic cell with one that is nearer to the cell's middle. Without them a
/// crowd is as dense as the cells are, and more even; points that stand further apart all stay. Of
/// equally near ones the first stays.
///
/// `points` in the order of their first coordinate, all finite; `side` > 0: of a cell. Cells are
/// counted from the least coordinates. O(n log m) for the m in one layer of cells.
std::vector<bool> crowding_points(const std::vector<Eigen::Vector3d>& points, double side);

}  // namespace instep
