#include "core/geometry/piles/pile_level.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/skin_outline.h"
#include "core/geometry/voxel_grid.h"
#include "core/median.h"

namespace instep {
namespace {

/// Sparser than this, in least sides, is no skin but what strays about.
constexpr double kWidestSide = 12.0;
/// Of those that the density is told in, in least sides.
constexpr double kCellOfDensity = 4.0;
/// A cell of more times the usual count is a pile. Of 390 bands of lasts and feet, even, random, as
/// modelled or noisy, one has 13; where the meridians of a modelled foot meet, 20.
constexpr double kPile = 30.0;
/// A block of so many times what is usual is the foot of one.
constexpr double kFoot = 2.0;
/// Cells of a block that a level sheet meets.
constexpr double kCellsOfSheet = 9.0;
/// Several cells of so many times the usual count are a pile if the noise of each is so many times
/// that of the rest, or the other way round. Of 7,985 girths of lasts, feet and drawn bodies 37
/// have as many such cells, with up to 2.3 times the noise of the rest. Noise too fine to matter is
/// none.
constexpr double kCrowded = 8.0;
constexpr std::size_t kSeveral = 5;
constexpr double kOtherNoise = 3.0;
constexpr double kLeastNoise = 0.01;  // of a side
/// Of so many other cells the noise is asked for.
constexpr std::size_t kAsked = 200;
constexpr double kMostlyFlat = 0.5;
constexpr int kMostWidenings = 2;
/// In least sides: a sixth of the section.
constexpr double kShadow = 24.0;

/// How far points scatter round the skin of each of some cells: one in `stride`. Nothing of those
/// that show none.
std::vector<double> scatters_of(const std::vector<Eigen::Vector3d>& points, const VoxelGrid& grid,
                                const std::vector<std::size_t>& cells, double side,
                                std::size_t stride) {
  std::vector<double> scatters;
  for (std::size_t i = 0; i < cells.size(); i += stride) {
    const CellBlock block(grid, cells[i]);
    const auto skin = BlockSkin::through(points, block, BlockView(points, block, side));
    if (skin) scatters.push_back(std::max(skin->scatter(), kLeastNoise));
  }
  return scatters;
}

/// Cells that are of no pile, nor beside one.
std::vector<std::size_t> cells_of_rest(const VoxelGrid& grid, const PileLevel& level) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const CellBlock block(grid, cell);
    if (!block.is_fringe() && !level.is_beside_pile(block)) cells.push_back(cell);
  }
  return cells;
}

/// Whether several of the cells scatter otherwise than the rest does.
bool have_other_noise(const std::vector<std::size_t>& cells,
                      const std::vector<Eigen::Vector3d>& points, const VoxelGrid& grid,
                      const PileLevel& level) {
  if (cells.size() < kSeveral) return false;
  const auto rest = cells_of_rest(grid, level);
  const std::size_t stride = 1 + rest.size() / kAsked;
  const double usual = median(scatters_of(points, grid, rest, level.side, stride));
  if (!(usual > 0.0)) return false;
  const auto scatters = scatters_of(points, grid, cells, level.side, 1);
  const auto others = std::count_if(scatters.begin(), scatters.end(), [&](double scatter) {
    return std::max(scatter, usual) > kOtherNoise * std::min(scatter, usual);
  });
  return static_cast<std::size_t>(others) >= kSeveral;
}

bool has_pile(const std::vector<Eigen::Vector3d>& points, const PileLevel& level) {
  const VoxelGrid grid(points, level.side);
  std::vector<std::size_t> crowded;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const std::size_t count = grid.members(cell).size();
    if (static_cast<double>(count) > kPile * level.usual) return true;
    if (level.is_crowded(count)) crowded.push_back(cell);
  }
  return have_other_noise(crowded, points, grid, level);
}

/// Whether cells are wide enough for piles to look like skin.
bool is_mostly_flat(const std::vector<Eigen::Vector3d>& points, const PileLevel& level) {
  const VoxelGrid grid(points, level.side);
  std::size_t all = 0;
  std::size_t flat = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const CellBlock block(grid, cell);
    if (!level.is_beside_pile(block) || block.is_fringe()) continue;
    ++all;
    if (BlockView(points, block, level.side).is_flat()) ++flat;
  }
  return static_cast<double>(flat) >= kMostlyFlat * static_cast<double>(all);
}

}  // namespace

bool PileLevel::is_crowded(std::size_t points_of_cell) const {
  return static_cast<double>(points_of_cell) > kCrowded * usual;
}

bool PileLevel::is_beside_pile(const CellBlock& block) const {
  return is_crowded(block.fullest()) ||
         static_cast<double>(block.size()) > kFoot * kCellsOfSheet * usual;
}

std::optional<PileLevel> level_beside_piles(const std::vector<Eigen::Vector3d>& points,
                                            double height, double least_side) {
  const double density = outline_of_skin(points, height, kCellOfDensity * least_side).density;
  if (!(density > 0.0)) return std::nullopt;
  const double side = std::max(least_side, 1.0 / std::sqrt(density));
  if (side > kWidestSide * least_side) return std::nullopt;
  PileLevel level{side, density * side * side, kShadow * least_side};
  if (!has_pile(points, level)) return std::nullopt;
  for (int i = 0; i < kMostWidenings && !is_mostly_flat(points, level); ++i) {
    level.side *= 2.0;
    level.usual *= 4.0;
  }
  return level;
}

}  // namespace instep
