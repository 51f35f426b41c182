#include "core/foot/skin_round.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
/// Of the sectors: 130 degrees, as a hole 30 mm wide leaves at its rim. So many random points leave
/// a wider one by a chance of 2e-6.
constexpr std::size_t kWidestGap = 13;
/// In the middle of a wide hole the nearest point is as far off as the 40th; of random points on
/// skin it is nearer than this share of that, but by a chance of 1e-9, and of a scanner's lines
/// that run round the place it is near.
constexpr double kNearestShare = 0.7;
constexpr double kNearMm = 15.0;

constexpr double kSectorAngle = 2.0 * std::numbers::pi / static_cast<double>(kSectors);

std::size_t sector_of(const Vector2d& offset) {
  const double turn = std::atan2(offset.y(), offset.x()) + std::numbers::pi;
  return std::min(static_cast<std::size_t>(turn / kSectorAngle), kSectors - 1);
}

Vector2d direction_of(std::size_t sector) {
  const double turn = (static_cast<double>(sector) + 0.5) * kSectorAngle - std::numbers::pi;
  return {std::cos(turn), std::sin(turn)};
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
  const Vector3d aside = outwards.unitOrthogonal();
  const Vector3d other = outwards.cross(aside);
  std::vector<Vector2d> near;
  for (const auto& point : points) {
    const Vector3d offset = point - place;
    if (std::abs(outwards.dot(offset)) > kDepthMm) continue;
    near.emplace_back(aside.dot(offset), other.dot(offset));
  }
  if (near.size() < kFewestNear) return false;
  const auto is_nearer = [](const Vector2d& a, const Vector2d& b) {
    return a.squaredNorm() < b.squaredNorm();
  };
  const auto last = near.begin() + kFewestNear - 1;
  std::nth_element(near.begin(), last, near.end(), is_nearer);
  const double reach = std::max(kReachMm, last->norm());
  const auto nearest = std::min_element(near.begin(), last + 1, is_nearer);
  if (nearest->norm() > std::max(kNearMm, kNearestShare * reach)) return false;
  std::array<bool, kSectors> is_filled{};
  for (const auto& offset : near) {
    const double distance = offset.norm();
    if (distance >= kLeastTellingMm && distance <= reach) is_filled[sector_of(offset)] = true;
  }
  for (std::size_t i = 0; i < kSectors; ++i) {
    const Vector2d direction = direction_of(i);
    const double rise = direction.x() * aside.z() + direction.y() * other.z();
    if (place.z() + reach * rise < 0.0) is_filled[i] = true;
  }
  return longest_gap(is_filled) < kWidestGap;
}

}  // namespace instep
