#include "core/fusion/outliers.h"

#include <algorithm>

#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr double kReachMm = 3.0;      // how far a point looks for company
constexpr double kLeastCrowd = 0.15;  // of the median number of points round one; fewer are strays
constexpr double kLinkMm = 3.0;       // points within about this (up to twice) belong together
constexpr std::size_t kLeastCluster = 50;  // smaller groups of points are strays

}  // namespace

std::vector<std::size_t> crowded_points(const PointCloud& cloud) {
  std::vector<std::size_t> kept;
  if (cloud.empty()) return kept;
  const VoxelGrid grid(cloud.positions, kReachMm);
  std::vector<std::size_t> crowds(cloud.size());  // points round each point, itself included
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    std::size_t crowd = 0;
    grid.each_near(cell, [&](std::size_t near) { crowd += grid.members(near).size(); });
    for (const std::uint32_t index : grid.members(cell)) crowds[index] = crowd;
  }
  const double least = kLeastCrowd * static_cast<double>(median(crowds));
  for (std::size_t i = 0; i < crowds.size(); ++i) {
    if (static_cast<double>(crowds[i]) >= least) kept.push_back(i);
  }
  return kept;
}

std::vector<std::size_t> clustered_points(const PointCloud& cloud) {
  std::vector<std::size_t> kept;
  if (cloud.empty()) return kept;
  const auto clusters = VoxelGrid(cloud.positions, kLinkMm).clusters_of_points();
  std::vector<std::size_t> sizes(*std::max_element(clusters.begin(), clusters.end()) + 1);
  for (const std::size_t cluster : clusters) ++sizes[cluster];
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (sizes[clusters[i]] >= kLeastCluster) kept.push_back(i);
  }
  return kept;
}

}  // namespace instep
