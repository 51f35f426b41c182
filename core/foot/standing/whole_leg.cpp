#include "core/foot/standing/whole_leg.h"

#include <limits>

#include "core/geometry/extent.h"
#include "core/geometry/moments.h"
#include "core/median.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kShortestFootMm = 120.0;
constexpr double kLongestFootMm = 360.0;
constexpr double kShortestLegMm = 400.0;  ///< longer than any foot, which may lie like a leg
constexpr double kLongLeg = 1.4;          ///< of the foot's length: shorter ones do no harm
constexpr double kSlimLeg = 0.75;         ///< of the foot's length, across the leg
constexpr double kThickLeg = 0.12;        ///< and the other way: a ruler is no leg
constexpr double kKept = 0.9;             ///< of the foot's length, over the sole
constexpr double kFootOfLeg = 0.15;       ///< of the leg's length, in which all of the foot's lies
constexpr double kLegFrom = 0.35;         ///< of the leg's length: over the ankle
constexpr double kLegTo = 0.95;
constexpr double kSlice = 0.05;
constexpr double kStrayShare = 0.002;
constexpr double kLargestLean = 0.82;  ///< cosine: of the shank against the whole

/// Of at least one point, without strays.
Extent extent_of_most(const Points& points, const Vector3d& direction) {
  std::vector<double> places;
  places.reserve(points.size());
  for (const auto& point : points) places.push_back(direction.dot(point));
  return {quantile(places, kStrayShare), quantile(places, 1.0 - kStrayShare)};
}

Points between(const Points& points, const Vector3d& up, double from, double to) {
  Points some;
  for (const auto& point : points) {
    const double place = up.dot(point);
    if (place >= from && place <= to) some.push_back(point);
  }
  return some;
}

struct Across {
  double longer = 0.0;
  double shorter = 0.0;
};

/// The extents of the points as seen along `up`; 0 of none.
Across extents_across(Points points, const Vector3d& up) {
  if (points.empty()) return {};
  for (auto& point : points) point -= up.dot(point) * up;
  const Vector3d longer = Moments::of(points).longest();
  return {extent_of_most(points, longer).length(),
          extent_of_most(points, up.cross(longer)).length()};
}

/// Whether a leg goes on all the way: what lies in line with a foot on the floor does not.
bool is_slim_all_along(const Points& points, const Vector3d& along, const Extent& leg,
                       double foot_mm) {
  for (double share = kLegFrom; share < kLegTo - 0.5 * kSlice; share += kSlice) {
    const double from = leg.from + share * leg.length();
    const Across slice =
        extents_across(between(points, along, from, from + kSlice * leg.length()), along);
    if (slice.longer > kSlimLeg * foot_mm || slice.shorter < kThickLeg * foot_mm) return false;
  }
  return true;
}

struct Leg {
  Vector3d up = Vector3d::UnitZ();  ///< along the shank
  double sole_mm = 0.0;             ///< its place along that
  double foot_mm = 0.0;             ///< how long the foot is
};

/// A leg whose foot is at the end away from `up`.
std::optional<Leg> leg_up(const Points& points, const Vector3d& up) {
  const Extent whole = extent_of_most(points, up);
  const Points upper = between(points, up, (whole.from + whole.to) / 2.0, whole.to);
  if (upper.empty()) return std::nullopt;
  // The foot turns the axis of the whole, but not that of the half without it.
  Vector3d along = Moments::of(upper).longest();
  if (along.dot(up) < 0.0) along = -along;
  if (along.dot(up) < kLargestLean) return std::nullopt;
  const Extent leg = extent_of_most(points, along);
  if (leg.length() < kShortestLegMm) return std::nullopt;
  const double end = leg.from + kFootOfLeg * leg.length();
  const double foot =
      extents_across(between(points, along, std::numeric_limits<double>::lowest(), end), along)
          .longer;
  const bool is_leg = foot >= kShortestFootMm && foot <= kLongestFootMm &&
                      leg.length() > kLongLeg * foot && is_slim_all_along(points, along, leg, foot);
  return is_leg ? std::optional(Leg{along, leg.from, foot}) : std::nullopt;
}

}  // namespace

std::optional<FootUnderLeg> foot_under_leg(const Points& points) {
  if (points.empty()) return std::nullopt;
  const Vector3d along = Moments::of(points).longest();
  const auto one = leg_up(points, along);
  const auto other = leg_up(points, -along);
  if (!one && !other) return std::nullopt;
  // A thigh over a slim shank looks like a short foot.
  const Leg& leg = !other || (one && one->foot_mm > other->foot_mm) ? *one : *other;
  FootUnderLeg foot;
  foot.kept_mm = kKept * leg.foot_mm;
  foot.up = leg.up;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (leg.up.dot(points[i]) - leg.sole_mm < foot.kept_mm) foot.points.push_back(i);
  }
  return foot;
}

}  // namespace instep
