#pragma once

#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/girth/contour/section_line.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// Cuts the faces with the plane and chains what is cut, exactly: corners with equal coordinates
/// count as one, a corner in the plane counts as above it, so that every crossed edge is met by
/// both of its faces. Then the lines are stitched(). Longest line first.
///
/// Faces with corners out of range or coordinates that are not finite must have been refused
/// before. O(faces + cut faces log cut faces), and what stitched() costs.
std::vector<SectionLine> cut(const TriangleMesh& mesh, const TapePlane& plane, const Seams& seams);

}  // namespace instep
