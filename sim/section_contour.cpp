#include "sim/section_contour.h"

#include <cmath>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kOnSkinMm = 1e-7;
constexpr double kLongestContourMm = 5000.0;

/// The solid's value as a function of the plane's coordinates.
class PlaneView {
 public:
  PlaneView(const Solid& solid, const TapePlane& plane) : solid_(solid), plane_(plane) {}

  double value(const Vector2d& at) const { return solid_.value(plane_.lift(at)); }

  Vector2d gradient(const Vector2d& at) const {
    const Vector3d slope = solid_.gradient(plane_.lift(at));
    return {slope.dot(plane_.u()), slope.dot(plane_.v())};
  }

  /// Down (or up) the slope to the skin.
  bool settle(Vector2d& at) const {
    for (int iteration = 0; iteration < 50; ++iteration) {
      const double height = value(at);
      if (std::abs(height) < kOnSkinMm) return true;
      const Vector2d slope = gradient(at);
      if (slope.squaredNorm() < 1e-12) return false;
      at -= height / slope.squaredNorm() * slope;
    }
    return false;
  }

  Vector2d tangent(const Vector2d& at) const {
    const Vector2d slope = gradient(at).normalized();
    return {-slope.y(), slope.x()};  // counter-clockwise round the body
  }

 private:
  const Solid& solid_;
  const TapePlane& plane_;
};

}  // namespace

Result<SectionContour> trace_section(const Solid& solid, const TapePlane& plane,
                                     const Vector3d& inside, double step_mm) {
  const PlaneView view(solid, plane);
  const auto no_section = [](const char* what) {
    return fail(ErrorCode::kInvalidInput, what, "choose another plane or another inner point");
  };
  Vector2d start = plane.project(inside);
  if (!(view.value(start) < 0.0)) return no_section("the point is not within the solid");
  double walked = 0.0;
  while (view.value(start) < 0.0 && walked < kLongestContourMm) {
    start.y() += 0.5;
    walked += 0.5;
  }
  if (!view.settle(start)) return no_section("the section has no edge");

  SectionContour contour;
  contour.polygon.push_back(start);
  Vector2d at = start;
  for (double length = 0.0; length < kLongestContourMm; length += step_mm) {
    at += step_mm * view.tangent(at);
    if (!view.settle(at)) return no_section("the section cannot be followed");
    if (length > 2.0 * step_mm && (at - start).norm() < step_mm) {
      contour.contact_mm = perimeter(contour.polygon);
      contour.stretched_mm = perimeter(convex_hull(contour.polygon));
      return contour;
    }
    contour.polygon.push_back(at);
  }
  return no_section("the section does not close");
}

}  // namespace instep
