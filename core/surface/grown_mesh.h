#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace instep {

/// A surface through unorganised points, grown from a seed triangle outwards (the paper, section
/// 2.2; in the spirit of Lin, Tai and Wang 2004, its reference 14). An edge of the border reaches
/// as far as the sampling round it is coarse; of the points in reach it takes the one that sees it
/// under the widest angle, as a Delaunay triangulation would, so that borders that meet agree on
/// the triangles between them. The triangle most in keeping with the sampling is grown first, one
/// that bends sharply last. Points that no triangle reached are seeds of further parts.
///
/// Needs no normals. The corners of the mesh are the points, in their order, whether a triangle
/// uses them or not; of points at the same place only the first is used. Each part is wound alike,
/// but inwards or outwards by chance. Holes wider than about four spacings stay open, and so does
/// what cannot be told: points in a line, noise thicker than the spacing. Millimetres, or any unit.
/// Coordinates must be finite. Deterministic. O(n log n): every edge tries each of its neighbours
/// once at most.
TriangleMesh grow_mesh(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
