#include "core/girth/contour/control_points.h"

#include <algorithm>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kBeside = 0.02;

}  // namespace

bool goes_by_control_points(const std::vector<Vector2d>& contour, const TapePlane& plane) {
  const double near = kBeside * perimeter(contour);
  const auto& points = plane.control_points();
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return nearest_on_border(contour, plane.project(point)).distance <= near;
  });
}

}  // namespace instep
