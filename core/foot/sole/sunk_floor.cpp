#include "core/foot/sole/sunk_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/foot/skin/skin_noise.h"
#include "core/geometry/moments.h"
#include "core/geometry/moments_round.h"
#include "core/geometry/place_hash.h"
#include "core/geometry/point_index.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kHarmlessMm = 0.5;
/// Of clouds of a real foot its back was 0.9 to 1.05 times as much too high on average with noise
/// in all directions (12 of 1.5 to 3 mm), 2.2 times with noise along z alone (8 of 1 and 1.5 mm).
constexpr double kSinks = 2.0;
constexpr double kFacesUp = 0.8;
constexpr std::size_t kLookedAt = 2000;
constexpr std::size_t kNeighbours = 20;
/// On either side of the axis.
constexpr std::size_t kAskedPlaces = 60;
constexpr std::size_t kFewestPlaces = 10;

bool faces_up(const PointIndex& index, const Vector3d& place) {
  const Moments moments = moments_round(index, place, index.nearest(place, kNeighbours));
  return std::abs(moments.flattest().z()) > kFacesUp;
}

/// Standard deviation along z, of the noisier side of the foot.
double noise_along_z(const FootScan& foot) {
  const SkinNoise skin(foot.cloud.positions);
  std::array<std::vector<std::size_t>, 2> sides;
  for (const std::size_t i : some_by_place(foot.cloud.positions, kLookedAt)) {
    const Vector3d& place = foot.cloud.positions[i];
    auto& side = sides[place.y() > 0.0 ? 0 : 1];
    if (side.size() == kAskedPlaces || !foot.cloud.was_seen(i)) continue;
    if (faces_up(skin.index(), skin.index().points()[i])) side.push_back(i);
  }
  double noise_mm = foot.quieted->quieting.noise_mm;
  for (const auto& side : sides) {
    if (side.size() < kFewestPlaces) continue;
    noise_mm = std::max(noise_mm, skin.deviation_mm(side));
  }
  return noise_mm;
}

}  // namespace

double sunk_floor_mm(const FootScan& foot) {
  if (!foot.quieted || foot.is_floor_known || !foot.cloud.stands_on_platform()) return 0.0;
  return kSinks * std::max(noise_along_z(foot) - kHarmlessMm, 0.0);
}

}  // namespace instep
