#include "core/girth/doubt/bends_in_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

namespace instep {
namespace {

/// As of an edge of 45 degrees: the sides of a sharper one run so near to each other that what lies
/// beyond their last points may be any length. All that such an edge adds is half of a 95 %
/// interval: of 299 girths of fins, keyholes and thin ellipses 80 % hold, with six tenths of it 78.
constexpr double kSharpestEdge = 0.75 * std::numbers::pi;

/// A short piece of the contour.
struct Bend {
  double begin;  ///< way along the contour
  double turn;
};

bool is_in_space(const BlendedSurface& surface, const Eigen::Vector2d& place) {
  const auto* patch = surface.leading_patch({place.x(), place.y(), 0.0});
  return patch != nullptr && std::holds_alternative<HermitePatch>(patch->field);
}

/// Those in the middle of which a patch in space leads, the sharpest first.
std::vector<Bend> sharp_bends(const ContourCourse& course, const BlendedSurface& surface,
                              double way) {
  std::vector<Bend> bends;
  for (std::size_t i = 0; i < course.contour().points.size(); ++i) {
    const Bend bend{course.way_to(i), course.turn_over(course.way_to(i), way)};
    if (!(std::abs(bend.turn) > kOrdinaryTurn)) continue;
    if (is_in_space(surface, course.place_at(bend.begin + 0.5 * way))) bends.push_back(bend);
  }
  std::stable_sort(bends.begin(), bends.end(), [](const Bend& a, const Bend& b) {
    return std::abs(a.turn) > std::abs(b.turn);
  });
  return bends;
}

}  // namespace

UnseenBends bends_in_space(const ContourCourse& course, const BlendedSurface& surface, double way) {
  UnseenBends sum;
  if (!(way > 0.0)) return sum;
  std::vector<Bend> counted;
  for (const Bend& bend : sharp_bends(course, surface, way)) {
    const bool overlaps = std::any_of(counted.begin(), counted.end(), [&](const Bend& other) {
      const double apart = std::abs(other.begin - bend.begin);
      return std::min(apart, course.length() - apart) < way;
    });
    if (overlaps) continue;
    counted.push_back(bend);
    const double longer = way * longer_by_corner(std::abs(bend.turn), kOrdinaryTurn, kSharpestEdge);
    sum.contact_u95 += longer;
    if (bend.turn > 0.0) sum.stretched_u95 += longer;
  }
  return sum;
}

}  // namespace instep
