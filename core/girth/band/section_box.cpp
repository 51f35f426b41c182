#include "core/girth/band/section_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/geometry/skin_outline.h"
#include "core/geometry/voxel_grid.h"
#include "core/girth/band/plane_slab.h"
#include "core/median.h"

namespace instep {
namespace {

/// Of the box round all against that round most of the points.
constexpr double kFarLarger = 1.5;
constexpr double kFew = 0.05;
/// How high a slab tells of the skin: against the one that is looked at first, and at most against
/// the box round most of its points.
constexpr double kThicker = 10.0;
constexpr double kThickest = 0.2;
/// Of a cell, in spacings.
constexpr double kSide = 3.0;
/// Of those that the density is told in.
constexpr double kCellInHeights = 1.5;
/// Cells that hang together are skin if they are at least this part of the most that do: one of two
/// bodies, or what a sparse part has of a body.
constexpr double kPartOfMost = 0.1;

/// Round the places but for those furthest to each side.
Eigen::AlignedBox2d box_of_most(const std::vector<Eigen::Vector3d>& places) {
  const auto few = static_cast<std::size_t>(kFew * static_cast<double>(places.size()));
  std::vector<double> y;
  for (const auto& place : places) y.push_back(place.y());
  const double low = quantile(y, kFew);
  const double high = quantile(std::move(y), 1.0 - kFew);
  return {Eigen::Vector2d(places[few].x(), low),
          Eigen::Vector2d(places[places.size() - 1 - few].x(), high)};
}

/// Round those cells that hang together with many.
Eigen::AlignedBox2d box_of_clusters(const std::vector<Eigen::Vector3d>& places, double side) {
  const VoxelGrid grid(places, side);
  const auto clusters = grid.clusters();
  std::vector<std::size_t> sizes(grid.cell_count(), 0);
  for (const std::size_t cluster : clusters) ++sizes[cluster];
  const auto most = static_cast<double>(*std::max_element(sizes.begin(), sizes.end()));
  Eigen::AlignedBox2d box;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (static_cast<double>(sizes[clusters[cell]]) < kPartOfMost * most) continue;
    for (const auto member : grid.members(cell)) box.extend(places[member].head<2>().eval());
  }
  return box;
}

}  // namespace

Eigen::AlignedBox2d section_box(
    const std::vector<Eigen::Vector3d>& slab, double height, double step,
    const std::function<std::vector<Eigen::Vector3d>(double height)>& wider) {
  Eigen::AlignedBox2d box;
  for (const auto& place : slab) box.extend(place.head<2>().eval());
  const double most = box_of_most(slab).diagonal().norm();
  if (box.diagonal().norm() <= kFarLarger * most) return box;
  const double thick = std::max(height, std::min(kThicker * height, kThickest * most));
  const auto steps = in_steps(wider(thick), step);
  const auto outline = outline_of_skin(steps, thick / step, kCellInHeights * height / step);
  if (!(outline.density > 0.0)) return box;
  auto of_skin = box_of_clusters(steps, kSide / std::sqrt(outline.density));
  // Where a dense part has most of the points the cells of the rest need not hang together.
  for (const auto& place : outline.places) of_skin.extend(place);
  return {step * of_skin.min(), step * of_skin.max()};
}

}  // namespace instep
