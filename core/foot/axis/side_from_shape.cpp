#include "core/foot/axis/side_from_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/foot/axis/outline_axis.h"
#include "core/foot/full_size.h"
#include "core/foot/skin/border_profile.h"
#include "core/foot/skin/border_smoothing.h"
#include "core/foot/skin/skin_round.h"
#include "core/geometry/extent.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// How far, as a share of the foot's length, each sign has to go to be worth one unit of evidence.
constexpr double kClearToeOffset = 0.03;
constexpr double kClearArchDepth = 0.02;
constexpr double kClearBallOffset = 0.05;
// Where less of either border was seen, its hollow and its ball are those of a rim. Of three real
// feet with a side cut off by planes 15 to 50 mm beside the axis 4 of 34 were told wrong and sure;
// none is so, and whole feet and lasts of 1,500 to 300,000 points are as sure as before, of 700
// few.
constexpr double kLeastSeenShare = 0.85;
constexpr double kMostOfHalfSeen = 0.75;  ///< confidence
constexpr double kLowMm = 45.0;

/// The two borders of the outline, both counted outwards from the axis.
struct Borders {
  BorderProfile left;   ///< towards +y
  BorderProfile right;  ///< towards -y
};

double middle(const Borders& borders, double place) {
  return (borders.left.reach(place).value_or(0.0) - borders.right.reach(place).value_or(0.0)) / 2.0;
}

/// How far the toes end to the left of the line through the middles of heel and ball.
double toe_offset(const std::vector<Vector2d>& outline, const Borders& borders, double length) {
  const double heel = middle(borders, 0.17 * length);
  const double ball = middle(borders, 0.65 * length);
  Extent toes = Extent::none();
  for (const auto& point : outline) {
    if (point.x() >= 0.965 * length) toes.include(point.y());
  }
  if (toes.is_none()) return 0.0;
  const double line_at_toes = heel + (ball - heel) * (0.98 - 0.17) / (0.65 - 0.17);
  return (toes.to + toes.from) / 2.0 - line_at_toes;
}

/// How deep a border dips under the straight line from heel to ball.
double hollow(const BorderProfile& border, double length) {
  const auto heel = border.reach(0.17 * length);
  const auto ball = border.reach(0.66 * length);
  if (!heel || !ball) return 0.0;
  double deepest = 0.0;
  for (double share = 0.25; share < 0.6; share += 0.01) {
    const double line = *heel + (*ball - *heel) * (share - 0.17) / (0.66 - 0.17);
    if (const auto reach = border.reach(share * length)) deepest = std::max(deepest, line - *reach);
  }
  return deepest;
}

/// How much further forward the left border protrudes at the ball than the right one.
double ball_offset(const Borders& borders, double length) {
  const auto left = borders.left.furthest(0.5 * length, 0.8 * length);
  const auto right = borders.right.furthest(0.5 * length, 0.8 * length);
  return left && right ? left->place - right->place : 0.0;
}

/// The furthest point of the outline at a place; `sign` +1 to the left.
std::optional<Vector3d> border_point(const std::vector<Vector3d>& low, double place, double sign) {
  constexpr double kBesideMm = 4.0;
  std::optional<Vector3d> furthest;
  for (const auto& point : low) {
    const bool is_near =
        std::abs(point.x() - place) < kBesideMm && point.z() < kOutlineHeightShare * kFullSizeMm;
    if (is_near && (!furthest || sign * point.y() > sign * furthest->y())) furthest = point;
  }
  return furthest;
}

/// Of a border from heel to ball, what is skin and not the rim of what was seen. `low`: the points
/// up to well over the outline.
double seen_share(const std::vector<Vector3d>& low, double sign) {
  constexpr double kFrom = 0.17;
  constexpr double kTo = 0.80;
  constexpr int kPlaces = 16;
  int seen = 0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double place = std::lerp(kFrom, kTo, static_cast<double>(i) / kPlaces) * kFullSizeMm;
    const auto point = border_point(low, place, sign);
    if (point && is_skin_all_round(low, *point, sign * Vector3d::UnitY())) ++seen;
  }
  return static_cast<double>(seen) / (kPlaces + 1);
}

double unit_evidence(double value, double clear) {
  return std::clamp(value / clear, -3.0, 3.0);
}

}  // namespace

SideGuess side_from_shape(const std::vector<Eigen::Vector3d>& points, double length_mm) {
  const double factor = full_size_factor(length_mm);
  std::vector<Vector2d> outline;
  for (const auto& point : points) {
    if (point.z() > kOutlineHeightShare * length_mm) continue;
    outline.emplace_back(factor * point.head<2>());
  }
  const Borders borders{{outline, Vector2d::UnitX(), Vector2d::UnitY(), kBorderSmoothingMm},
                        {outline, Vector2d::UnitX(), -Vector2d::UnitY(), kBorderSmoothingMm}};

  const double for_right =
      unit_evidence(toe_offset(outline, borders, kFullSizeMm), kClearToeOffset * kFullSizeMm) +
      unit_evidence(hollow(borders.left, kFullSizeMm) - hollow(borders.right, kFullSizeMm),
                    kClearArchDepth * kFullSizeMm) +
      unit_evidence(ball_offset(borders, kFullSizeMm), kClearBallOffset * kFullSizeMm);
  return {for_right >= 0.0 ? Side::kRight : Side::kLeft,
          1.0 / (1.0 + std::exp(-std::abs(for_right)))};
}

SideGuess guess_by_seen_borders(SideGuess guess, const std::vector<Vector3d>& points,
                                double length_mm) {
  const double factor = full_size_factor(length_mm);
  std::vector<Vector3d> low;
  for (const auto& point : points) {
    if (factor * point.z() < kLowMm) low.emplace_back(factor * point);
  }
  if (std::min(seen_share(low, 1.0), seen_share(low, -1.0)) < kLeastSeenShare) {
    guess.confidence = std::min(guess.confidence, kMostOfHalfSeen);
  }
  return guess;
}

}  // namespace instep
