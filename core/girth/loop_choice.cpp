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
    char length[32];
    std::snprintf(length, sizeof length, "%.1f", perimeter(loops[i]));
    warnings.push_back("the plane cuts another closed loop, " + std::string(length) +
                       " mm long, which does not count");
  }
  auto chosen = std::move(loops.front());
  if (signed_area(chosen) < 0.0) std::reverse(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace instep
