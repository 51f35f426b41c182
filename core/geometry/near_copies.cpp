#include "core/geometry/near_copies.h"

#include <algorithm>
#include <cstddef>

#include "core/geometry/voxel_grid.h"
#include "core/stride.h"

namespace instep {

std::vector<bool> near_copies(const std::vector<Eigen::Vector3d>& points, double apart) {
  const VoxelGrid grid(points, apart);
  std::vector<std::size_t> cells(points.size());
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    for (const auto member : grid.members(cell)) cells[member] = cell;
  }
  std::vector<bool> copies(points.size(), false);
  // A cell has room for few that stay, however many crowd in it.
  std::vector<std::vector<std::size_t>> staying(grid.cell_count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_copy = false;
    grid.each_near(cells[i], [&](std::size_t cell) {
      is_copy = is_copy || std::any_of(staying[cell].begin(), staying[cell].end(), [&](auto other) {
                  return (points[i] - points[other]).norm() <= apart;
                });
    });
    copies[i] = is_copy;
    if (!is_copy) staying[cells[i]].push_back(i);
  }
  return copies;
}

double share_of_near_copies(const PointIndex& index, double apart, std::size_t sample) {
  const std::size_t count = index.points().size();
  if (count < 2 || sample == 0) return 0.0;
  const std::size_t stride = stride_to_at_least(sample, count);
  double asked = 0.0;
  double found = 0.0;
  for (std::size_t i = 0; i < count; i += stride) {
    const auto nearest = index.nearest(index.points()[i], 2);
    asked += 1.0;
    if (nearest.back().squared_distance <= apart * apart) found += 1.0;
  }
  return found / asked;
}

}  // namespace instep
