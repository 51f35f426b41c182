#include "core/girth/contour/loop_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon.h"
#include "core/girth/contour/control_points.h"
#include "core/in_millimetres.h"

namespace instep {

SectionLine choose_loop(std::vector<SectionLine> lines, const TapePlane& plane,
                        std::vector<std::string>& warnings) {
  std::erase_if(lines, [](const SectionLine& line) { return !line.closed; });
  std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
    return std::abs(signed_area(a.points)) > std::abs(signed_area(b.points));
  });
  std::stable_partition(lines.begin(), lines.end(), [&](const SectionLine& line) {
    return lines.size() > 1 && goes_by_control_points(line.points, plane);
  });
  for (std::size_t i = 1; i < lines.size(); ++i) {
    warnings.push_back(other_loop_warning(lines[i].length()));
  }
  SectionLine chosen = std::move(lines.front());
  if (signed_area(chosen.points) < 0.0) std::reverse(chosen.points.begin(), chosen.points.end());
  return chosen;
}

std::string other_loop_warning(double length_mm) {
  return "the plane cuts another closed loop, " + in_millimetres(length_mm) +
         " long, which does not count";
}

}  // namespace instep
