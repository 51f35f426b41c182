#include "core/geometry/piled_points.h"

#include <algorithm>

#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

/// A cell of more times the usual count is a pile. Of 5,790 clouds of lasts and feet, even, random,
/// as modelled or noisy, none has one.
constexpr std::size_t kPile = 8;
/// Strays and the fringe of thick noise have cells nearly to themselves: up to half of all.
constexpr double kUsual = 0.75;

}  // namespace

std::optional<std::size_t> usual_beside_piles(const std::vector<std::size_t>& counts) {
  const std::size_t usual = quantile(counts, kUsual);
  const bool piled = std::any_of(counts.begin(), counts.end(),
                                 [&](std::size_t count) { return count > kPile * usual; });
  return piled ? std::optional(usual) : std::nullopt;
}

std::vector<bool> piled_points(const std::vector<Eigen::Vector3d>& points, double side,
                               std::size_t usual) {
  const VoxelGrid grid(points, side);
  std::vector<bool> piled(points.size(), false);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto members = grid.members(cell);
    if (members.size() <= usual) continue;
    for (const auto member : members) piled[member] = true;
    for (std::size_t i = 0; i < usual; ++i) piled[members[i * members.size() / usual]] = false;
  }
  return piled;
}

}  // namespace instep
