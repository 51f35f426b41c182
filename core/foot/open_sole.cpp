#include "core/foot/open_sole.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/foot/full_size.h"
#include "core/fusion/close_sole.h"
#include "core/geometry/moments.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUndersideShare = 0.08;  ///< of the length: an arch may be so high
constexpr double kLowMm = 64.0;           ///< what stands higher says nothing of the ground below
constexpr double kMiddleMm = 20.0;        ///< height over the floor that lies within the foot
constexpr double kCellMm = 8.0;
constexpr std::size_t kNeighbours = 14;
constexpr std::size_t kMostOfWalls = 100000;  ///< their bends are told by no more

/// To full size, where the foot is looked at.
double factor_of(const FootScan& foot) {
  return full_size_factor(foot.landmarks.at("acropodion").position_mm.x());
}

using Cell = std::pair<long, long>;

Cell cell_of(const Vector3d& point) {
  return {std::lround(point.x() / kCellMm), std::lround(point.y() / kCellMm)};
}

/// Normals of a wall round a foot, pointing away from the foot's middle line.
std::vector<Vector3d> wall_normals(const std::vector<Vector3d>& points) {
  const PointIndex index(points);
  std::vector<Vector3d> normals;
  normals.reserve(points.size());
  for (const auto& point : points) {
    const auto close = index.nearest(point, kNeighbours);
    Moments moments;
    for (const auto& one : close) moments.add(points[one.index] - point);
    Vector3d normal = moments.flattest();
    const Vector3d middle(std::clamp(point.x(), 0.12 * kFullSizeMm, 0.85 * kFullSizeMm), 0.0,
                          kMiddleMm);
    if (normal.dot(point - middle) < 0.0) normal = -normal;
    normals.push_back(normal);
  }
  return normals;
}

}  // namespace

bool is_sole_open(const FootScan& foot) {
  if (foot.cloud.stands_on_platform()) return false;
  // Walls stand on the border of the ground that is covered, so that only ground further in tells.
  std::map<Cell, bool> ground;
  std::map<long, std::pair<long, long>> rows;
  const double factor = factor_of(foot);
  for (const auto& own : foot.cloud.positions) {
    const Vector3d point = factor * own;
    if (point.z() > kLowMm) continue;
    const Cell cell = cell_of(point);
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
  // As high as the lowest seen end of a wall may be, and as much above it as tells its bend.
  constexpr double kWallHeightMm = kHighestWallEndMm + kWallBendReachMm;
  SoleSettings settings;
  const double factor = factor_of(foot);
  // Looked at as a foot of full size, but what is added is as it says on the foot itself.
  settings.spacing_mm *= factor;
  settings.sigma_mm *= factor;
  std::vector<std::size_t> low;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    if (factor * foot.cloud.positions[i].z() < kWallHeightMm) low.push_back(i);
  }
  PointCloud walls = foot.cloud.subset(low);
  if (walls.size() > kMostOfWalls) {
    walls = walls.subset(some_by_place(walls.positions, kMostOfWalls));
  }
  walls.drop_errors_along_normals();  // what is added has none
  for (auto& place : walls.positions) place *= factor;
  if (walls.size() < kNeighbours) return;
  if (!walls.has_normals()) walls.normals = wall_normals(walls.positions);
  const std::size_t seen = walls.size();
  close_sole(walls, 0.0, settings);
  std::vector<std::size_t> added;
  for (std::size_t i = seen; i < walls.size(); ++i) added.push_back(i);
  if (added.empty()) return;
  if (foot.cloud.origins.empty()) foot.cloud.origins.assign(foot.cloud.size(), PointOrigin::kSeen);
  PointCloud sole = walls.subset(added);
  for (auto& place : sole.positions) place /= factor;
  foot.cloud.append(sole);
  if (foot.quieted) foot.quieted->cloud.append(sole);
  foot.warnings.emplace_back("the sole was not seen: it is taken to stand flat on the floor");
}

}  // namespace instep
