#include "core/girth/control_points.h"

#include <algorithm>
#include <limits>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kBeside = 0.02;

double distance_to_edge(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double part = squared > 0.0 ? (point - from).dot(along) / squared : 0.0;
  return (from + std::clamp(part, 0.0, 1.0) * along - point).norm();
}

double distance_to(const std::vector<Vector2d>& contour, const Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vector2d& to = contour[(i + 1) % contour.size()];
    nearest = std::min(nearest, distance_to_edge(point, contour[i], to));
  }
  return nearest;
}

}  // namespace

bool goes_by_control_points(const std::vector<Vector2d>& contour, const TapePlane& plane) {
  const double near = kBeside * perimeter(contour);
  const auto& points = plane.control_points();
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return distance_to(contour, plane.project(point)) <= near;
  });
}

}  // namespace instep
