#include "core/girth/loop_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/geometry/polygon.h"

namespace instep {

std::vector<Eigen::Vector2d> choose_loop(std::vector<std::vector<Eigen::Vector2d>> loops,
                                         std::vector<std::string>& warnings) {
  std::stable_sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) {
    return std::abs(signed_area(a)) > std::abs(signed_area(b));
  });
  for (std::size_t i = 1; i < loops.size(); ++i) {
    warnings.push_back(other_loop_warning(perimeter(loops[i])));
  }
  auto chosen = std::move(loops.front());
  if (signed_area(chosen) < 0.0) std::reverse(chosen.begin(), chosen.end());
  return chosen;
}

std::string other_loop_warning(double length_mm) {
  char length[32];
  std::snprintf(length, sizeof length, "%.1f", length_mm);
  return "the plane cuts another closed loop, " + std::string(length) +
         " mm long, which does not count";
}

}  // namespace instep
