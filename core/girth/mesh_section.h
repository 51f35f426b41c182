#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// A line that a plane cuts out of a mesh, in the plane's own coordinates. A closed one does not
/// repeat its first point.
struct SectionLine {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
  /// Widest gap that was joined in it.
  double widest_seam = 0.0;

  /// Its own length, with the closing edge of a closed line.
  double length() const;
};

/// Cuts the faces with the plane and chains what is cut, exactly: corners with equal coordinates
/// count as one, a corner in the plane counts as above it, so that every crossed edge is met by
/// both of its faces. Then open ends that lie within `seam` of each other are joined, nearest
/// first: the seams of faces that were never stitched. Longest line first.
///
/// Faces with corners out of range or coordinates that are not finite must have been refused
/// before. O(faces + cut faces log cut faces + open ends squared).
std::vector<SectionLine> cut(const TriangleMesh& mesh, const TapePlane& plane, double seam);

}  // namespace instep
