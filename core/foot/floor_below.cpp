#include "core/foot/floor_below.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/low_walls.h"
#include "core/fusion/wall_end.h"
#include "core/fusion/wall_foot.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr double kEdgeMm = 11.0;  ///< radius of a sole's edge, by two feet of one scanner
constexpr double kDoubtShare = 0.5;
/// What ends clearly above it stands over an arch or between toes.
constexpr double kOverFloorMm = -2.0;
constexpr std::size_t kMostPoints = 20000;

}  // namespace

FloorBelow floor_below(const FootScan& foot) {
  if (foot.is_floor_known) return {};
  const LowWalls walls(foot, kMostPoints);
  std::vector<double> depths;
  for (const auto& end : find_wall_ends(walls.points, kHighestWallEndMm, kWallBendReachMm)) {
    const double depth = kEdgeMm * (1.0 + end.normal.z()) - end.position.z();
    if (depth > kOverFloorMm) depths.push_back(depth);
  }
  if (depths.empty()) return {};
  const double depth = std::max(0.0, median(std::move(depths))) / walls.to_full_size;
  return {depth, kDoubtShare * depth};
}

std::vector<RedrawnLandmarks> if_deeper(const FootScan& foot) {
  if (foot.floor_below.u95_mm == 0.0) return {};
  const RigidTransform higher(Eigen::Translation3d(0.0, 0.0, foot.floor_below.u95_mm));
  FootScan deeper = aligned_as(foot, transformed(higher, foot.shape()));
  for (auto& [name, landmark] : deeper.landmarks) {
    landmark.position_mm = higher * landmark.position_mm;
  }
  mark(deeper);
  return {{std::move(deeper.landmarks), higher.inverse()}};
}

}  // namespace instep
