#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/result.h"
#include "core/surface/paper/octree_surface.h"

namespace instep {

struct ConstrainedSurfaceOptions {
  /// Length of the edge of a unit cube, > 0. Without it: a hundredth of the longest extent.
  std::optional<double> cube_mm;
};

/// The surface through a cloud, or through a part of one, as triangles: the paper's section 3 from
/// the first step to the last. The cloud is seen in its principal frame (3.1), its local RBF
/// surface is reconstructed (3.2, 3.3, 4), and marching cubes gives the triangles (3.4), each unit
/// cube only if some of it lies where the cylinder rule admits it along Z, X and Y, so that the
/// surface ends where the points do, or less than a cube further.
///
/// Millimetres, in the frame of the points; wound counter-clockwise seen from outside as far as the
/// side could be told. Fails as OctreeSurface::reconstruct(), with kInvalidInput for cubes that are
/// too small, and with kInsufficientData where nothing of the surface is left.
Result<TriangleMesh> constrained_surface(const std::vector<Eigen::Vector3d>& points,
                                         const ConstrainedSurfaceOptions& options = {},
                                         const SurfaceProgress& progress = {});

}  // namespace instep
