#include "core/geometry/rectangle.h"

#include <algorithm>
#include <limits>

namespace instep {
namespace {

double extent(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& direction) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const auto& point : points) {
    least = std::min(least, direction.dot(point));
    most = std::max(most, direction.dot(point));
  }
  return most - least;
}

}  // namespace

RectangleSides enclosing_rectangle(const std::vector<Eigen::Vector2d>& hull) {
  RectangleSides best;
  double best_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0.0)) continue;
    const Eigen::Vector2d along = edge.normalized();
    const double a = extent(hull, along);
    const double b = extent(hull, {-along.y(), along.x()});
    if (a * b >= best_area) continue;
    best_area = a * b;
    best = {std::max(a, b), std::min(a, b)};
  }
  return best;
}

}  // namespace instep
