#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/girth/tape_plane.h"
#include "core/result.h"
#include "sim/solids/solid.h"

namespace instep {

/// A solid cut by a plane, by following the zero of its value: truth that no cloud and no mesh
/// stands behind.
struct SectionContour {
  std::vector<Eigen::Vector2d> polygon;  ///< in the plane's own coordinates; closed, every corner
                                         ///< within 1e-6 mm of the skin
  double contact_mm = 0.0;               ///< along the skin
  double stretched_mm = 0.0;             ///< of its convex hull
};

/// The closed section that surrounds `inside`, a point of the plane within the solid, in the
/// solid's frame. `step_mm` is the distance of corners: a girth is short by step^2 / (24 r^2) of
/// its length where the radius of curvature is r. Corners of the solid sharper than that are cut by
/// up to half a step.
///
/// Fails with kInvalidInput if `inside` is not within the solid or the contour does not close.
/// Cost: about 10 us a corner for a foot.
Result<SectionContour> trace_section(const Solid& solid, const TapePlane& plane,
                                     const Eigen::Vector3d& inside, double step_mm = 0.1);

}  // namespace instep
