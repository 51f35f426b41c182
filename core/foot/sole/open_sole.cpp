#include "core/foot/sole/open_sole.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/foot/full_size.h"
#include "core/foot/sole/low_walls.h"
#include "core/fusion/sole/close_sole.h"
#include "core/geometry/point_spacing.h"
#include "core/in_millimetres.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUndersideShare = 0.08;  ///< of the length: an arch may be so high
constexpr double kLowMm = 64.0;           ///< what stands higher says nothing of the ground below
constexpr double kCellMm = 8.0;
constexpr double kCellInSpacings = 2.0;       ///< of sparse points: in few such cells is none
constexpr std::size_t kSparsePoints = 10000;  ///< more leave no larger cells
constexpr std::size_t kMostOfWalls = 100000;  ///< their bends are told by no more

using Cell = std::pair<long, long>;

Cell cell_of(const Vector3d& point, double cell_mm) {
  return {std::lround(point.x() / cell_mm), std::lround(point.y() / cell_mm)};
}

double cell_for(const std::vector<Vector3d>& points, double factor) {
  constexpr std::size_t kAsked = 500;
  if (points.size() > kSparsePoints) return kCellMm;
  return std::max(kCellMm, kCellInSpacings * factor * usual_spacing(PointIndex(points), kAsked));
}

/// What was guessed of the floor, where it matters.
std::string how_deep(const FloorBelow& floor) {
  constexpr double kWorthSayingMm = 0.5;
  if (floor.depth_mm + floor.u95_mm < kWorthSayingMm) return "";
  return ", which by the bend of its edge lies " + in_millimetres(floor.depth_mm) +
         " below its lowest skin, give or take " + in_millimetres(floor.u95_mm) +
         ": leave some floor round the foot in the cloud, and it is known";
}

}  // namespace

bool is_sole_open(const FootScan& foot) {
  if (foot.cloud.stands_on_platform()) return false;
  // Walls stand on the border of the ground that is covered, so that only ground further in tells.
  std::map<Cell, bool> ground;
  std::map<long, std::pair<long, long>> rows;
  const double factor = full_size_factor(foot.length_mm());
  const double cell_mm = cell_for(foot.cloud.positions, factor);
  for (const auto& own : foot.cloud.positions) {
    const Vector3d point = factor * own;
    if (point.z() > kLowMm) continue;
    const Cell cell = cell_of(point, cell_mm);
    auto& is_covered = ground[cell];
    is_covered = is_covered || point.z() < kUndersideShare * kFullSizeMm;
    const auto [row, is_new] = rows.try_emplace(cell.first, cell.second, cell.second);
    row->second.first = std::min(row->second.first, cell.second);
    row->second.second = std::max(row->second.second, cell.second);
  }
  constexpr long kMarginCells = 2;
  std::size_t inside = 0;
  std::size_t covered = 0;
  for (const auto& [x, reach] : rows) {
    for (long y = reach.first + kMarginCells; y <= reach.second - kMarginCells; ++y) {
      ++inside;
      const auto cell = ground.find({x, y});
      if (cell != ground.end() && cell->second) ++covered;
    }
  }
  return 2 * covered < inside;
}

void close_open_sole(FootScan& foot) {
  LowWalls walls(foot, kMostOfWalls);
  const std::size_t seen = walls.points.size();
  if (seen == 0) {
    foot.warnings.emplace_back(
        "the sole was not seen, nor enough of the walls over it to tell where it ends: scan with "
        "more points, or with the sole in view");
    return;
  }
  SoleSettings settings;
  // Looked at as a foot of full size, but what is added is as it says on the foot itself.
  settings.spacing_mm *= walls.to_full_size;
  settings.sigma_mm *= walls.to_full_size;
  close_sole(walls.points, 0.0, settings);
  std::vector<std::size_t> added;
  for (std::size_t i = seen; i < walls.points.size(); ++i) added.push_back(i);
  if (added.empty()) return;
  if (foot.cloud.origins.empty()) foot.cloud.origins.assign(foot.cloud.size(), PointOrigin::kSeen);
  PointCloud sole = walls.points.subset(added);
  for (auto& place : sole.positions) place /= walls.to_full_size;
  foot.cloud.append(sole);
  if (foot.quieted) foot.quieted->cloud.append(sole);
  foot.warnings.push_back("the sole was not seen: it is taken to stand flat on the floor" +
                          how_deep(foot.floor_below));
}

}  // namespace instep
