#include "core/girth/section/unseen_side.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "core/girth/section/section_evidence.h"
#include "core/mean.h"

namespace instep {

UnseenSide widest_unseen_side(const PlaneBand& band) {
  std::vector<Eigen::Vector2d> places;
  for (const auto& point : band.points) {
    if (std::abs(point.position.z()) > evidence_reach(band)) continue;
    places.emplace_back(point.position.head<2>());
  }
  if (places.empty()) return {2.0 * std::numbers::pi, 0.0};
  const Eigen::Vector2d middle = mean_of(places);
  std::vector<std::pair<double, std::size_t>> angles;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d arm = places[i] - middle;
    angles.emplace_back(std::atan2(arm.y(), arm.x()), i);
  }
  std::sort(angles.begin(), angles.end());
  UnseenSide widest;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const bool last = i + 1 == angles.size();
    const auto& [next_angle, next] = angles[last ? 0 : i + 1];
    const double angle = next_angle - angles[i].first + (last ? 2.0 * std::numbers::pi : 0.0);
    if (angle <= widest.angle) continue;
    widest = {angle, (places[next] - places[angles[i].second]).norm()};
  }
  return widest;
}

}  // namespace instep
