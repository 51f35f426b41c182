#include "core/geometry/rectangle.h"

#include <algorithm>
#include <limits>

#include "core/geometry/extent.h"

namespace instep {

RectangleSides enclosing_rectangle(const std::vector<Eigen::Vector2d>& hull) {
  RectangleSides best;
  double best_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0.0)) continue;
    const Eigen::Vector2d along = edge.normalized();
    const double a = extent_along(hull, along).length();
    const double b = extent_along(hull, Eigen::Vector2d(-along.y(), along.x())).length();
    if (a * b >= best_area) continue;
    best_area = a * b;
    best = {std::max(a, b), std::min(a, b)};
  }
  return best;
}

}  // namespace instep
