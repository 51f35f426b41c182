#include "core/foot/sole/floor_below.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "core/foot/sole/low_walls.h"
#include "core/fusion/sole/wall_end.h"
#include "core/fusion/sole/wall_foot.h"
#include "core/geometry/point_index.h"
#include "core/geometry/point_spacing.h"
#include "core/geometry/polygon.h"
#include "core/median.h"

namespace instep {
namespace {

constexpr double kEdgeMm = 11.0;  ///< radius of a sole's edge, by two feet of one scanner
constexpr double kDoubtShare = 0.5;
/// What ends clearly above it stands over an arch or between toes.
constexpr double kOverFloorMm = -2.0;
constexpr std::size_t kMostPoints = 20000;
/// What ends so far within the border of all low skin may be the underside of a toe or an arch.
constexpr double kOnBorderMm = 4.0;
constexpr double kLowMm = 30.0;
constexpr std::size_t kFewestOnBorder = 12;
/// Sine by which the usual end on the border dips at least. Of three scanned feet cut off over the
/// floor it was 0.25 to 0.56 at 2 and 5 mm and 0.15 and 0.22 at 10 mm, of the third -0.10 there;
/// at 15 mm and more it was at most 0.05. Points over 4 mm apart blur the edge: of those feet at 8
/// mm in 2,500 points it was -0.08 to 0.08, in 1,500 points -0.19 to -0.04.
constexpr double kLeastDip = 0.1;
constexpr double kCloseMm = 4.0;
constexpr double kBlurredPerMm = 0.08;
constexpr double kMostBlurred = 0.3;

double least_dip(const PointCloud& walls) {
  constexpr std::size_t kAsked = 500;
  const double spacing = usual_spacing(PointIndex(walls.positions), kAsked);
  return kLeastDip - std::min(kMostBlurred, kBlurredPerMm * std::max(0.0, spacing - kCloseMm));
}

/// Whether the skin's border still stands upright, or leads outwards, where it was seen last.
bool end_upright(const std::vector<WallEnd>& ends, const PointCloud& walls) {
  std::vector<Eigen::Vector2d> low;
  for (const auto& place : walls.positions) {
    if (place.z() < kLowMm) low.push_back(place.head<2>());
  }
  const auto border = convex_hull(std::move(low));
  std::vector<double> dips;
  for (const auto& end : ends) {
    if (depth_in(border, end.position.head<2>()) < kOnBorderMm) dips.push_back(-end.normal.z());
  }
  return dips.size() >= kFewestOnBorder && median(std::move(dips)) < least_dip(walls);
}

}  // namespace

std::optional<FloorBelow> floor_below(const FootScan& foot) {
  if (foot.is_floor_known) return FloorBelow{};
  const LowWalls walls(foot, kMostPoints);
  const auto ends = find_wall_ends(walls.points, kHighestWallEndMm, kWallBendReachMm);
  if (end_upright(ends, walls.points)) return std::nullopt;
  std::vector<double> depths;
  for (const auto& end : ends) {
    const double depth = kEdgeMm * (1.0 + end.normal.z()) - end.position.z();
    if (depth > kOverFloorMm) depths.push_back(depth);
  }
  if (depths.empty()) return FloorBelow{};
  const double depth = std::max(0.0, median(std::move(depths))) / walls.to_full_size;
  return FloorBelow{depth, kDoubtShare * depth};
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
