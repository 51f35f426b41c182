#include "core/foot/standing/unseen_half.h"

#include <cmath>
#include <cstddef>

#include "core/degree.h"
#include "core/geometry/wall_facing.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kEndShare = 0.35;  ///< of the length, to either end of it
constexpr double kLowShare = 0.15;  ///< of the length: below the ankle
// Degrees off the axis that a half of an end and the side beside it face: where that was seen, a
// half that was not is a hole.
constexpr double kLeastAside = 10.0;
constexpr double kMostAside = 110.0;
constexpr std::size_t kClearly = 15;  ///< points show a half
// Of the points of one half to those of the other. All simulated feet that two neighbouring cameras
// look at have less; of 106 scans by others a toe's is 0.043 and more, a heel's 0.16.
constexpr double kLeastShare = 0.02;

/// Points whose skin faces outwards and to the left, and to the right.
struct Halves {
  std::size_t left = 0;
  std::size_t right = 0;
};

/// Of the heel, or with `forwards` of the toes.
Halves halves_of_end(const FootScan& foot, bool forwards) {
  const double length = foot.length_mm();
  Halves halves;
  for (std::size_t i = 0; i < foot.cloud.size(); ++i) {
    const Vector3d& point = foot.cloud.positions[i];
    const Vector3d& normal = foot.cloud.normals[i];
    const double from_end = forwards ? length - point.x() : point.x();
    if (from_end > kEndShare * length || point.z() > kLowShare * length) continue;
    if (normal.z() > kMostUpwardOfWall || !foot.cloud.was_seen(i)) continue;
    const double outwards = forwards ? normal.x() : -normal.x();
    const double aside = std::atan2(std::abs(normal.y()), outwards) / kDegree;
    if (aside < kLeastAside || aside > kMostAside) continue;
    ++(normal.y() > 0.0 ? halves.left : halves.right);
  }
  return halves;
}

bool is_hidden_beside(std::size_t half, std::size_t other) {
  return other >= kClearly && static_cast<double>(half) < kLeastShare * static_cast<double>(other);
}

}  // namespace

std::optional<std::string> unseen_half(const FootScan& foot) {
  if (!foot.cloud.has_normals()) return std::nullopt;
  for (const bool forwards : {false, true}) {
    const auto [left, right] = halves_of_end(foot, forwards);
    const std::string end = forwards ? " half of its toes" : " half of its heel";
    if (is_hidden_beside(left, right)) return "the left" + end;
    if (is_hidden_beside(right, left)) return "the right" + end;
  }
  return std::nullopt;
}

}  // namespace instep
