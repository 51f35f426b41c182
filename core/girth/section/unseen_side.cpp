#include "core/girth/section/unseen_side.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/girth/section/section_evidence.h"
#include "core/mean.h"

namespace instep {
namespace {

/// A side (radians) on which no point lies, from the middle of them all, that keeps a section open.
constexpr double kNotableSide = 0.5;

}  // namespace

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

tl::unexpected<Error> does_not_close(const PlaneBand& band) {
  const std::string what = "the section at the tape plane does not close";
  const UnseenSide side = widest_unseen_side(band);
  // From the middle of a thin body neighbours beside it lie at far different angles.
  if (side.angle < kNotableSide || side.across < evidence_reach(band)) {
    return fail(ErrorCode::kInsufficientData, what + ", though there are points all round it",
                "take away strays, a floor or what else touches the body, or scan from nearer");
  }
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.0f mm", band.unit_mm * side.across);
  return fail(ErrorCode::kInsufficientData,
              what + ": there are no points over some " + figure + " of it",
              "scan the body from there too");
}

}  // namespace instep
