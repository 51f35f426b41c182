#include "core/girth/bends_in_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

#include "core/girth/contour_course.h"

namespace instep {
namespace {

constexpr double kOrdinaryTurn = 0.2 * std::numbers::pi;
/// An edge that turns more may be any length.
constexpr double kSharpestTurn = 0.75 * std::numbers::pi;
/// Part of what an edge may add that is half of a 95 % interval.
constexpr double kLikely = 1.0;

/// The contour from a corner on, as far as points lie apart.
struct Bend {
  double way;
  double turn;
};

/// Those led by patches in space, the sharpest first.
std::vector<Bend> sharp_bends(const Contour& contour, const ContourCourse& course,
                              const BlendedSurface& surface, double spacing) {
  std::vector<Bend> bends;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const double way = course.way_to(i);
    const bool is_over = way + spacing > course.length();
    const double turn = course.turn_at(is_over ? way + spacing - course.length() : way + spacing) -
                        course.turn_at(way) + (is_over ? course.whole_turn() : 0.0);
    if (!(std::abs(turn) > kOrdinaryTurn)) continue;
    const Eigen::Vector2d middle = course.place_at(way + 0.5 * spacing);
    const auto* patch = surface.leading_patch({middle.x(), middle.y(), 0.0});
    if (patch != nullptr && std::holds_alternative<HermitePatch>(patch->field))
      bends.push_back({way, turn});
  }
  std::stable_sort(bends.begin(), bends.end(), [](const Bend& a, const Bend& b) {
    return std::abs(a.turn) > std::abs(b.turn);
  });
  return bends;
}

}  // namespace

UnseenBends bends_in_space(const Contour& contour, const BlendedSurface& surface, double spacing) {
  UnseenBends sum;
  if (!(spacing > 0.0)) return sum;
  const ContourCourse course(contour);
  std::vector<Bend> counted;
  for (const Bend& bend : sharp_bends(contour, course, surface, spacing)) {
    const bool overlaps = std::any_of(counted.begin(), counted.end(), [&](const Bend& other) {
      const double apart = std::abs(other.way - bend.way);
      return std::min(apart, course.length() - apart) < spacing;
    });
    if (overlaps) continue;
    counted.push_back(bend);
    const double longer =
        kLikely * spacing * longer_by_corner(std::abs(bend.turn), kOrdinaryTurn, kSharpestTurn);
    sum.contact_u95 += longer;
    if (bend.turn > 0.0) sum.stretched_u95 += longer;
  }
  return sum;
}

}  // namespace instep
