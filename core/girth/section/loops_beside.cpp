#include "core/girth/section/loops_beside.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// In grains: skin that begins no further off may be the section's.
constexpr double kNearInGrains = 3.0;
/// Area against the square of the length: of a rectangle four times as long as it is wide.
constexpr double kThin = 0.04;
/// Area against the section's: no body beside it, whatever its shape.
constexpr double kSmall = 0.01;
/// In grains: as far beyond the loop, at its tip and at its root, a fin may reach that closes only
/// over a part of itself.
constexpr double kBeyondInGrains = 2.0;

double gap_between(const SectionLoop& section, const SectionLoop& other) {
  double gap = section.index.length();
  for (const auto& corner : other.contour.points) {
    gap = std::min(gap, section.index.foot_of(corner).distance);
  }
  return gap;
}

bool may_be_fin(const SectionLoop& loop, const SectionLoop& section) {
  const double area = signed_area(loop.contour.points);
  return area < kThin * std::pow(loop.contour.length(), 2) ||
         area < kSmall * signed_area(section.contour.points);
}

}  // namespace

LoopsBeside loops_beside(const PlaneBand& band, const std::vector<SectionLoop>& loops) {
  LoopsBeside beside;
  const auto& section = loops.front().contour.points;
  const double beyond = kBeyondInGrains * band.grain;
  std::vector<Eigen::Vector2d> with_fins = section;
  for (std::size_t i = 1; i < loops.size(); ++i) {
    const double gap = gap_between(loops.front(), loops[i]);
    const bool is_near = gap <= kNearInGrains * band.grain;
    beside.gaps.push_back(is_near ? std::optional(gap) : std::nullopt);
    if (!is_near || !may_be_fin(loops[i], loops.front())) continue;
    beside.contact += loops[i].contour.length() + 2.0 * (gap + beyond);
    const auto& corners = loops[i].contour.points;
    with_fins.insert(with_fins.end(), corners.begin(), corners.end());
  }
  if (with_fins.size() > section.size()) {
    beside.stretched =
        perimeter(convex_hull(std::move(with_fins))) - perimeter(convex_hull(section)) + beyond;
  }
  return beside;
}

}  // namespace instep
