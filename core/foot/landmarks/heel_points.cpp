#include "core/foot/landmarks/heel_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/foot/landmarks/standing_heel.h"
#include "core/foot/skin/border_smoothing.h"
#include "core/foot/skin/skin_round.h"
#include "core/foot/skin/stationary_reach.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kSixth = 1.0 / 6.0;
constexpr double kHeelMm = 40.0;  ///< of the foot itself
constexpr double kRearShare = 0.2;
constexpr double kStepMm = 0.5;
constexpr double kHalfWidthShare = 0.12;      ///< beside the axis
constexpr double kHeelSlope = 0.45;           ///< radians: from the instep point down to the heel
constexpr double kHeelRangeShare = 0.1;       ///< to either side of the line that slopes so
constexpr double kMostUnderFloorMm = 2.0;     ///< where the border's own end runs away
constexpr double kLowestOfHeelMm = 6.0;       ///< below it no wall of a heel reaches furthest
constexpr double kFarthestFromSeenMm = 15.0;  ///< a wall that is guessed
/// One standard deviation of where such a one is, for each millimetre from what was seen: set by
/// eye, of holes 70 mm wide in the wall of a heel whose sole was not seen it was 6 mm too far in.
constexpr double kGuessedWallShare = 0.25;
/// Of a place that no fit tells: what it is where no point shows the edge.
const Vector3d kUsuallyOff(-0.4, 0.0, 1.0);
constexpr double kJunctionSlope = 0.62;  ///< radians: from the heel up to the junction
constexpr double kLeastRise = 0.40;
constexpr double kMostRise = 0.85;

Vector3d rising(double radians) {
  return {std::cos(radians), 0.0, std::sin(radians)};
}

double seen_from_side(const Vector3d& a, const Vector3d& b) {
  return std::hypot(a.x() - b.x(), a.z() - b.z());
}

template <typename Chooser>
SkinBorder side_view(const FootOutline& outline, const Vector3d& outwards, const Chooser& chosen) {
  std::vector<Vector3d> points;
  for (const auto& point : outline.points()) {
    if (chosen(point)) points.push_back(point);
  }
  const double half_width = kHalfWidthShare * outline.length_mm();
  const Vector3d along(-outwards.z(), 0.0, outwards.x());
  return {
      points, {along, outwards, Vector3d::UnitY(), -half_width, half_width}, kBorderSmoothingMm};
}

/// The breadth of the outline at a place.
std::optional<double> breadth(const FootOutline& outline, double along) {
  const auto medial = outline.medial().reach(along);
  const auto lateral = outline.lateral().reach(along);
  return medial && lateral ? std::optional(*medial + *lateral) : std::nullopt;
}

/// Whether a place is on a wall that was seen, or goes on from what was seen. Where nothing of a
/// wall was, what was put under the foot ends somewhere on the platform.
bool is_on_wall(const FootOutline& outline, const Vector3d& place) {
  return place.z() < kLowestOfHeelMm ? outline.was_seen(place)
                                     : outline.distance_to_seen(place) < kFarthestFromSeenMm;
}

std::optional<Landmark> at_heel(const FootOutline& outline, const SkinBorder& border,
                                HeelBreadthRule rule) {
  const auto along = heel_breadth_place(outline, rule);
  const auto place = along ? border.at(*along) : std::nullopt;
  if (!place) return std::nullopt;
  const Vector3d position = border.position(*place);
  const bool is_skin = is_on_wall(outline, position) &&
                       is_skin_all_round(outline.points(), position, border.view().outwards);
  if (!is_skin) return std::nullopt;
  Landmark heel{position, 0.9, std::string("outline of the heel ") + description(rule)};
  if (!outline.was_seen(position)) {
    heel.deviations_off_mm = {kGuessedWallShare * outline.distance_to_seen(position) *
                              border.view().outwards};
  }
  return heel;
}

/// The place of a border, within a range, that counts most.
template <typename Worth>
std::optional<Vector3d> best_place(const SkinBorder& border, double from, double to,
                                   const Worth& worth) {
  std::optional<Vector3d> best;
  double most = 0.0;
  for (double along = from; along <= to; along += kStepMm) {
    const auto place = border.at(along);
    if (!place) continue;
    const Vector3d point = border.position(*place);
    if (best && worth(point) <= most) continue;
    best = point;
    most = worth(point);
  }
  return best;
}

}  // namespace

std::optional<double> heel_breadth_place(const FootOutline& outline, HeelBreadthRule rule) {
  if (rule == HeelBreadthRule::kSixth) return kSixth * outline.length_mm();
  if (rule == HeelBreadthRule::kFortyMm) return kHeelMm * outline.factor();
  std::optional<double> place;
  double most = 0.0;
  for (double along = 0.0; along <= kRearShare * outline.length_mm(); along += kStepMm) {
    const auto here = breadth(outline, along);
    if (!here || *here <= most) continue;
    most = *here;
    place = along;
  }
  return place;
}

std::optional<Landmark> find_heel_medial(const FootOutline& outline, HeelBreadthRule rule) {
  return at_heel(outline, outline.medial(), rule);
}

std::optional<Landmark> find_heel_lateral(const FootOutline& outline, HeelBreadthRule rule) {
  return at_heel(outline, outline.lateral(), rule);
}

std::optional<Landmark> find_heel_point(const FootOutline& outline, const Landmark& instep,
                                        HeelStance stance) {
  const double length = outline.length_mm();
  const Vector3d down = -rising(kHeelSlope);
  const auto heel = side_view(outline, down, [&](const Vector3d& point) {
    return point.x() < 0.2 * length && point.z() < 0.2 * length;
  });
  const Vector3d along(-down.z(), 0.0, down.x());
  const double middle = along.dot(instep.position_mm);
  const double range = kHeelRangeShare * length;
  const auto is_under_floor = [](const Vector3d& place) { return place.z() < -kMostUnderFloorMm; };
  const auto point = best_place(heel, middle - range, middle + range, [&](const Vector3d& place) {
    return is_under_floor(place) ? -std::numeric_limits<double>::infinity()
                                 : seen_from_side(place, instep.position_mm);
  });
  if (!point || is_under_floor(*point)) return std::nullopt;
  Landmark found{*point, 0.8, "point of the heel's side view furthest from the instep point"};
  const auto is_in_range = [&](const Vector3d& place) {
    return std::abs(along.dot(place) - middle) <= range && !is_under_floor(place);
  };
  const Vector3d& origin = instep.position_mm;
  if (stance == HeelStance::kOnFloor) {
    const auto fitted = furthest_of_standing_heel(outline.seen_points(), length, origin);
    const bool is_fitted = fitted && is_in_range(fitted->place);
    if (is_fitted) found.position_mm = fitted->place;
    found.deviations_off_mm = {is_fitted ? fitted->one_deviation_off_mm : kUsuallyOff};
  } else {
    constexpr ReachPatch kWide{10.0, 16.0};
    const auto refined = furthest_reach(outline.points(), origin, *point, kWide);
    if (refined && is_in_range(*refined)) found.position_mm = *refined;
  }
  if (!is_skin_all_round(outline.points(), found.position_mm, down)) return std::nullopt;
  return found;
}

std::optional<Landmark> find_junction(const FootOutline& outline, const Landmark& heel) {
  const double length = outline.length_mm();
  const Vector3d& origin = heel.position_mm;
  const auto rise = [&](const Vector3d& point) {
    return std::atan2(point.z() - origin.z(), point.x() - origin.x());
  };
  const auto back = side_view(outline, rising(kJunctionSlope), [&](const Vector3d& point) {
    return point.x() > 0.15 * length && point.z() > 0.12 * length && point.x() < 0.75 * length &&
           rise(point) < kMostRise + 0.15;
  });
  const double middle =
      Vector3d(-std::sin(kJunctionSlope), 0.0, std::cos(kJunctionSlope)).dot(origin);
  double highest_rise = 0.0;
  const auto point =
      best_place(back, middle - 0.3 * length, middle + 0.3 * length, [&](const Vector3d& place) {
        const double own = rise(place);
        if (own < kLeastRise || own > kMostRise) return -1e6;
        highest_rise = std::max(highest_rise, own);
        return -seen_from_side(place, origin);
      });
  constexpr double kMarginRad = 0.02;
  const auto is_between_rays = [&](const Vector3d& place) {
    return rise(place) >= kLeastRise && rise(place) <= highest_rise - kMarginRad;
  };
  if (!point || !is_between_rays(*point)) return std::nullopt;
  constexpr ReachPatch kWide{15.0, 10.0};
  const auto refined = nearest_reach(outline.points(), origin, *point, kWide);
  return Landmark{refined && is_between_rays(*refined) ? *refined : *point, 0.7,
                  "point of the back's side view nearest to the heel point"};
}

}  // namespace instep
