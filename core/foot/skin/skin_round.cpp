#include "core/foot/skin/skin_round.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/plane_vectors.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReachMm = 12.0;
constexpr double kDepthMm = 20.0;
constexpr std::size_t kFewestNear = 40;
/// Nearer ones tell nothing: some lie between a place and a rim.
constexpr double kLeastTellingMm = 6.0;
constexpr std::size_t kSectors = 36;
/// Of the sectors that lie over the floor, where all do: 130 degrees, as a hole 30 mm wide leaves
/// at its rim. So many random points leave a wider one by a chance of 2e-6.
constexpr std::size_t kWidestGap = 13;
/// In the middle of a wide hole the nearest point is as far off as the 40th; of random points on
/// skin it is nearer than this share of that, but by a chance of 1e-9, and of lines of a scanner up
/// to 30 mm apart it is near.
constexpr double kNearestShare = 0.7;
constexpr double kNearMm = 15.0;

constexpr double kSectorAngle = 2.0 * std::numbers::pi / static_cast<double>(kSectors);

Vector2d direction_of(std::size_t sector) {
  const double turn = (static_cast<double>(sector) + 0.5) * kSectorAngle - std::numbers::pi;
  return {std::cos(turn), std::sin(turn)};
}

/// Below skin that faces up lies the sole.
double depth_below(const Vector3d& place, const Vector3d& outwards) {
  constexpr double kShareOfHeight = 0.6;
  if (!(outwards.z() > 0.0)) return kDepthMm;
  return std::min(kDepthMm, kShareOfHeight * std::max(0.0, place.z()) / outwards.z());
}

/// How points lie round a place, as seen along a direction.
class Sight {
 public:
  Sight(const Vector3d& place, const Vector3d& outwards)
      : place_(place),
        outwards_(outwards),
        depth_mm_(depth_below(place, outwards)),
        aside_(outwards.unitOrthogonal()),
        other_(outwards.cross(aside_)) {}

  /// Offsets from the place of the points that are not too deep, up to a distance from it.
  std::vector<Vector2d> offsets(const std::vector<Vector3d>& points, double most_mm) const {
    const double most_squared = most_mm * most_mm + depth_mm_ * depth_mm_;
    std::vector<Vector2d> found;
    for (const auto& point : points) {
      const Vector3d offset = point - place_;
      if (offset.squaredNorm() > most_squared) continue;
      if (std::abs(outwards_.dot(offset)) > depth_mm_) continue;
      const Vector2d seen(aside_.dot(offset), other_.dot(offset));
      if (seen.norm() <= most_mm) found.push_back(seen);
    }
    return found;
  }

  /// Of a place so far off in a direction.
  double height(const Vector2d& direction, double distance) const {
    return place_.z() + distance * (direction.x() * aside_.z() + direction.y() * other_.z());
  }

 private:
  Vector3d place_;
  Vector3d outwards_;
  double depth_mm_;
  Vector3d aside_;
  Vector3d other_;
};

/// Those up to kReachMm off or, if they are too few, the nearest; fewer if there are no more.
std::vector<Vector2d> nearest_offsets(const std::vector<Vector3d>& points, const Sight& sight) {
  auto near = sight.offsets(points, kReachMm);
  if (near.size() >= kFewestNear) return near;
  near = sight.offsets(points, std::numeric_limits<double>::infinity());
  if (near.size() <= kFewestNear) return near;
  std::nth_element(
      near.begin(), near.begin() + kFewestNear - 1, near.end(),
      [](const Vector2d& a, const Vector2d& b) { return a.squaredNorm() < b.squaredNorm(); });
  near.resize(kFewestNear);
  return near;
}

/// The most that follow each other round the circle.
std::size_t longest_gap(const std::array<bool, kSectors>& is_filled) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (std::size_t i = 0; i < 2 * kSectors; ++i) {
    run = is_filled[i % kSectors] ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest;
}

}  // namespace

bool is_skin_all_round(const std::vector<Vector3d>& points, const Vector3d& place,
                       const Vector3d& outwards) {
  const Sight sight(place, outwards);
  const auto near = nearest_offsets(points, sight);
  if (near.size() < kFewestNear) return false;
  double nearest = std::numeric_limits<double>::infinity();
  double reach = kReachMm;
  std::array<bool, kSectors> is_filled{};
  for (const auto& offset : near) {
    const double distance = offset.norm();
    nearest = std::min(nearest, distance);
    reach = std::max(reach, distance);
    if (distance >= kLeastTellingMm) is_filled[sector_of(offset, kSectors)] = true;
  }
  if (nearest > std::max(kNearMm, kNearestShare * reach)) return false;
  std::size_t over_floor = 0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    const bool is_over = sight.height(direction_of(i), reach) >= 0.0;
    is_filled[i] = is_filled[i] || !is_over;
    over_floor += is_over ? 1 : 0;
  }
  return longest_gap(is_filled) * kSectors < kWidestGap * over_floor;
}

}  // namespace instep
