#include "core/fusion/outliers.h"

#include <algorithm>

#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {

std::vector<std::size_t> crowded_points(const PointCloud& cloud, const OutlierSettings& settings) {
  std::vector<std::size_t> kept;
  if (cloud.empty()) return kept;
  const VoxelGrid grid(cloud.positions, settings.reach_mm);
  std::vector<std::size_t> crowds(cloud.size());  // points round each point, itself included
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    std::size_t crowd = 0;
    for (const std::size_t near : grid.neighbourhood(cell)) crowd += grid.members(near).size();
    for (const std::uint32_t index : grid.members(cell)) crowds[index] = crowd;
  }
  const double least = settings.least_crowd * static_cast<double>(median(crowds));
  for (std::size_t i = 0; i < crowds.size(); ++i) {
    if (static_cast<double>(crowds[i]) >= least) kept.push_back(i);
  }
  return kept;
}

std::vector<std::size_t> clustered_points(const PointCloud& cloud,
                                          const OutlierSettings& settings) {
  std::vector<std::size_t> kept;
  if (cloud.empty()) return kept;
  const auto clusters = VoxelGrid(cloud.positions, settings.link_mm).clusters_of_points();
  std::vector<std::size_t> sizes(*std::max_element(clusters.begin(), clusters.end()) + 1);
  for (const std::size_t cluster : clusters) ++sizes[cluster];
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (sizes[clusters[i]] >= settings.least_cluster) kept.push_back(i);
  }
  return kept;
}

}  // namespace instep
