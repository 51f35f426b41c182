#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace instep {

/// A surface through unorganised points, grown from a seed triangle outwards (the paper, section
/// 2.2; in the spirit of Lin, Tai and Wang 2004, its reference 14). Of the points that an edge of
/// the border can reach it takes the one that adds the least length, so that the surface comes near
/// a triangulation of least weight; how far it reaches depends on the sampling round it. The
/// triangle most in keeping with the sampling is grown first, one that bends sharply last. Points
/// far from all triangles are seeds of further parts.
///
/// Needs no normals. The corners of the mesh are the points, in their order, whether a triangle
/// uses them or not; of points at the same place only the first is used. Each part is a manifold
/// wound alike, but inwards or outwards by chance. Holes wider than about four spacings stay open,
/// and so does what cannot be told: points in a line, or in rows eight times further apart than
/// the points in them, noise as thick as the spacing. Any unit; the same mesh in each. Coordinates
/// must be finite. Deterministic. O(n log n): every edge tries some of its neighbours, twice.
TriangleMesh grow_mesh(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
