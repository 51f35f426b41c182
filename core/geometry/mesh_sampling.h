#pragma once

#include "core/geometry/point_cloud.h"
#include "core/geometry/triangle_mesh.h"

namespace instep {

/// The same surface with each distinct corner once: corners at exactly the same place become one
/// (the first), corners of no triangle and triangles that lost a corner are left out. Makes a
/// surface of a triangle soup such as an STL file. O(n log n).
TriangleMesh welded(const TriangleMesh& mesh);

/// The same surface with triangles whose edges are at most `longest_edge_mm` long: longer ones are
/// halved, the longest of a triangle first, each at its middle from both sides, so that no cracks
/// appear. The old corners keep their indices. Deterministic.
///
/// At two million corners it stops halving and leaves the rest as it is: is_refined() tells. Then
/// there may be cracks, where an edge was halved for one of its faces only.
TriangleMesh refined(const TriangleMesh& mesh, double longest_edge_mm);

/// True if no edge is longer than `longest_edge_mm`.
bool is_refined(const TriangleMesh& mesh, double longest_edge_mm);

/// The corners of a mesh as a cloud, in the same order, with the area-weighted normals of their
/// faces, pointing out of the body.
///
/// Each connected piece of surface is turned so that it encloses a positive volume about the
/// centre of the whole (for a piece where that says little, as the whole does). Normals are left
/// out altogether if somewhere neighbouring faces are wound against each other, or if a corner has
/// no face. Give a mesh that is welded() where corners may be repeated. Coordinates must be finite.
PointCloud corners_with_normals(const TriangleMesh& mesh);

}  // namespace instep
