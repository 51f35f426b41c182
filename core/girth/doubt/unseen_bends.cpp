#include "core/girth/doubt/unseen_bends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace instep {
namespace {

/// Part of what a corner may add that is half of a 95 % interval: chosen together with the turns,
/// by drawn cases and by a sole without points within 12 mm of its edge, of which 94 % hold: of
/// 1,240 drawn cases 30 become more than a fifth wider by them, of which 4 did not hold before, and
/// all do with them.
constexpr double kLikely = 1.2;

/// How much longer a corner is than the arc that turns as far, against that.
double corner_over_arc(double turn) {
  return std::tan(0.5 * turn) / (0.5 * turn) - 1.0;
}

/// No body bulges further out of sight than by half a circle over the hole, against the hole.
constexpr double kHalfCircle = 0.5 * std::numbers::pi;

/// What may be too much of a stretch that bulges more than a body would over a hole that wide.
double spur_over(double gap, double hole) {
  return gap > kHalfCircle * hole ? gap - hole : 0.0;
}

}  // namespace

double longer_by_corner(double turn, double ordinary, double sharpest) {
  return corner_over_arc(std::clamp(turn, ordinary, sharpest)) - corner_over_arc(ordinary);
}

UnseenBends unseen_bends_of(const ContourCourse& course, const std::vector<double>& ways,
                            double near) {
  UnseenBends sum;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const bool last = i + 1 == ways.size();
    const std::size_t next = last ? 0 : i + 1;
    const double gap = ways[next] - ways[i] + (last ? course.length() : 0.0);
    if (gap <= near) continue;
    const double turn = course.turn_over(ways[i], gap);
    const double hole = (course.place_at(ways[next]) - course.place_at(ways[i])).norm();
    const double longer =
        kLikely * (gap - near) * longer_by_corner(std::abs(turn), kOrdinaryTurn, kSharpestCorner) +
        spur_over(gap, hole);
    sum.contact_u95 = std::hypot(sum.contact_u95, longer);
    if (turn > 0.0) sum.stretched_u95 = std::hypot(sum.stretched_u95, longer);
  }
  return sum;
}

}  // namespace instep
