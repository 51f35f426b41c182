#include "core/foot/axis/foot_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foot/axis/axis_turn.h"
#include "core/foot/full_size.h"
#include "core/foot/landmarks/second_toe.h"
#include "core/foot/skin/border_crest.h"
#include "core/foot/skin/end_facing.h"
#include "core/foot/skin/robust_extreme.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

// A round leaves some 0.4 of the turn that is left.
constexpr int kMostRounds = 8;
constexpr double kStandsStillRad = 3e-4;
// A heel is round: its rearmost place on a small patch wanders sideways, and turns the axis. How
// far back it reaches is read on a small one, which no kink beside it can pull.
constexpr CrestPatch kHeelPatch{15.0, 14.0};
constexpr CrestPatch kReachPatch{7.0, 8.5};
/// How high the end of one that was not seen is taken to lie: well over the sole.
constexpr double kHeelHeightShare = 0.075;
/// A crest so far from where the points end was drawn out through few or uneven ones: of 80 halves
/// of a last's vertices by 5 to 8 mm in three.
constexpr double kFurthestCrestMm = 3.0;
/// Points nearer to the middle of a heel are skin there: set by eye; of 4 mm cut off it is 15 to
/// either side.
constexpr double kSkinMm = 6.0;

/// At full size.
Points outline_points(const Points& points, double length) {
  const double factor = full_size_factor(length);
  Points low;
  for (const auto& point : points) {
    if (point.z() <= kOutlineHeightShare * length) low.emplace_back(factor * point);
  }
  return low;
}

/// Points of one end, so that the search for its extreme is short.
Points beyond(const Points& points, const Vector3d& direction, double distance) {
  Points end;
  for (const auto& point : points) {
    if (direction.dot(point) > distance) end.push_back(point);
  }
  return end.empty() ? points : end;
}

Points moved(const RigidTransform& transform, Points points) {
  for (auto& point : points) point = transform * point;
  return points;
}

Vector3d rearmost_skin(const Points& heel, double length) {
  const Vector3d back = -Vector3d::UnitX();
  const Vector3d start = robust_extreme(heel, back);
  const BorderView from_behind{Vector3d::UnitY(), back, Vector3d::UnitZ(), 0.0,
                               kOutlineHeightShare * length};
  const auto crest = crest_near(heel, from_behind, {start.y(), -start.x(), start.z()}, kHeelPatch);
  if (!crest) return start;
  const auto close = crest_near(heel, from_behind, *crest, kReachPatch);
  const double end = close ? -close->reach : start.x();
  if (std::abs(end - start.x()) > kFurthestCrestMm) return start;
  return {end, crest->along, crest->across};
}

struct HeelEnd {
  Vector3d place;
  bool is_seen = true;
};

/// Of a heel that was not seen to its end the rearmost place is a corner of what is left, and the
/// axis through it was 5 to 9 degrees off with 12 mm of a heel missing: midway between the borders
/// it is 0.2. There no skin is then; on that of a shoe last, which may face to the side where it
/// reaches furthest, there is.
HeelEnd heel_end(const Points& points, double length) {
  const Vector3d back = -Vector3d::UnitX();
  const Points heel = beyond(points, back, -kHeelShare * length);
  const Vector3d seen = rearmost_skin(heel, length);
  const auto facing = end_facing(heel, seen, back);
  if (facing && *facing >= kLeastFacingOfHeel) return {seen};
  const Vector3d below(seen.x(), seen.y(), 0.0);
  const auto middle =
      heel_middle(moved(RigidTransform(Eigen::Translation3d(-below)), heel), length);
  if (!middle) return {seen};
  const Vector3d end(seen.x(), seen.y() + *middle, kHeelHeightShare * length);
  const bool is_skin = std::any_of(heel.begin(), heel.end(), [&](const Vector3d& point) {
    return (point - end).norm() < kSkinMm;
  });
  if (is_skin) return {seen};
  return {end, false};
}

Vector3d foremost(const Points& points, double from) {
  return robust_extreme(beyond(points, Vector3d::UnitX(), from), Vector3d::UnitX());
}

/// How high the skin is that reaches forwards to the tip of a toe; `otherwise` where there is none.
double tip_height(const Points& points, const Vector2d& tip, double otherwise) {
  constexpr double kBesideMm = 4.0;
  constexpr double kBehindMm = 8.0;
  Points toe;
  for (const auto& point : points) {
    const bool is_near =
        std::abs(point.y() - tip.y()) < kBesideMm && std::abs(point.x() - tip.x()) < kBehindMm;
    if (is_near) toe.push_back(point);
  }
  return toe.empty() ? otherwise : robust_extreme(toe, Vector3d::UnitX()).z();
}

/// Counted from the heel, with the medial side on +y.
Points as_right_foot(Points points, const Vector3d& heel, double medial_sign) {
  for (auto& point : points) {
    point -= heel;
    point.y() *= medial_sign;
  }
  return points;
}

/// The same, seen from above.
std::vector<Vector2d> outline_of_right_foot(const Points& points, const Vector3d& heel,
                                            double medial_sign) {
  std::vector<Vector2d> outline;
  outline.reserve(points.size());
  for (const auto& point : points) {
    outline.emplace_back(point.x() - heel.x(), medial_sign * (point.y() - heel.y()));
  }
  return outline;
}

/// How far the axis is off what the rule has, on a right foot. Where its points do not show what
/// that needs, the rule becomes that of the second toe, or without one that of the outline.
std::optional<double> turn_by(AxisRule& rule, const std::optional<SecondToe>& toe,
                              const Points& right_foot, double length) {
  const auto turn_of = [&](AxisRule one) {
    if (one != AxisRule::kSecondToe) return axis_turn(one, right_foot, length);
    return toe ? std::optional(std::atan2(toe->tip.y(), toe->tip.x())) : std::nullopt;
  };
  for (const AxisRule next : {AxisRule::kSecondToe, AxisRule::kOutline}) {
    if (const auto turn = turn_of(rule)) return turn;
    rule = next;
  }
  return turn_of(rule);
}

/// The axis of a foot that was seen larger than it is, by a factor.
FootAxis on_foot(FootAxis axis, double factor) {
  axis.foot_from_standing.translation() /= factor;
  axis.pternion /= factor;
  axis.acropodion /= factor;
  if (axis.toe2_tip) *axis.toe2_tip /= factor;
  return axis;
}

/// Of the points of the outline at full size.
FootAxis axis_of(const Points& low, RigidTransform start, Side side, AxisRule rule) {
  const double medial_sign = side == Side::kRight ? 1.0 : -1.0;
  FootAxis axis;
  axis.rule = rule;
  axis.foot_from_standing = std::move(start);
  double turn = 0.0;
  double share = 1.0;
  for (int round = 0; round < kMostRounds; ++round) {
    const Points points = moved(axis.foot_from_standing, low);
    const auto [rear, is_seen] = heel_end(points, kFullSizeMm);
    const Vector3d heel(rear.x(), rear.y(), 0.0);
    axis.foot_from_standing = RigidTransform(Eigen::Translation3d(-heel)) * axis.foot_from_standing;
    axis.pternion = rear - heel;
    axis.is_heel_seen = is_seen;
    axis.acropodion = foremost(points, rear.x() + 0.75 * kFullSizeMm) - heel;
    const auto toe = find_second_toe(outline_of_right_foot(points, heel, medial_sign), kFullSizeMm);
    axis.toe2_tip.reset();
    axis.is_second_toe_resolved = toe && toe->is_resolved;
    if (toe) {
      const Vector2d tip(toe->tip.x(), medial_sign * toe->tip.y());
      const double height = tip_height(points, tip + heel.head<2>(), axis.acropodion.z());
      axis.toe2_tip = {tip.x(), tip.y(), height};
    }
    const auto wanted =
        turn_by(axis.rule, toe, as_right_foot(points, heel, medial_sign), axis.acropodion.x());
    if (!wanted) break;
    // Where the tip jumps to and fro between two toes or rules, the axis comes to rest between.
    if (medial_sign * *wanted * turn < 0.0) share *= 0.5;
    turn = share * medial_sign * *wanted;
    if (std::abs(turn) < kStandsStillRad || round + 1 == kMostRounds) break;
    axis.foot_from_standing =
        RigidTransform(Eigen::AngleAxisd(-turn, Vector3d::UnitZ())) * axis.foot_from_standing;
  }
  return axis;
}

}  // namespace

FootAxis find_foot_axis(const Points& standing_points, const OutlineAxis& start, Side side,
                        AxisRule rule) {
  const double factor = full_size_factor(start.length_mm);
  RigidTransform axis_from_standing = start.axis_from_standing();
  axis_from_standing.translation() *= factor;
  const Points low = outline_points(standing_points, start.length_mm);
  return on_foot(axis_of(low, axis_from_standing, side, rule), factor);
}

}  // namespace instep
