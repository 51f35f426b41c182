#include "core/foot/measures/standing_girth.h"

#include <utility>

#include "core/geometry/polygon.h"

namespace instep {

Girth standing_girth(Girth fitted, const TapePlane& plane) {
  // In the plane's own coordinates the height over the platform is `up` . p + origin's height.
  const Eigen::Vector2d up(plane.u().z(), plane.v().z());
  auto standing = clipped(fitted.contour, up, -plane.origin().z());
  if (standing.size() < 3) return fitted;
  fitted.contact_mm += perimeter(standing) - perimeter(fitted.contour);
  fitted.stretched_mm += perimeter(convex_hull(standing)) - perimeter(convex_hull(fitted.contour));
  fitted.contour = std::move(standing);
  return fitted;
}

}  // namespace instep
