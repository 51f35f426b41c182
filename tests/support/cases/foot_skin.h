#pragma once

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"
#include "sim/solids/foot_solid.h"

namespace instep::test {

/// The skin of a simulated foot up to a height, open there, as triangles of some millimetres: fine
/// enough to spread points evenly, which settle_on_skin() then moves to the skin itself.
TriangleMesh rough_skin(const FootSolid& foot, double top_mm);

/// Moves points that lie near the skin to it, and gives them its normals.
void settle_on_skin(const FootSolid& foot, PointCloud& cloud);

}  // namespace instep::test
