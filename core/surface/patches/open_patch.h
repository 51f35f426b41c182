#pragma once

#include <vector>

#include "core/surface/oriented_point.h"
#include "core/surface/patches/surface_patch.h"

namespace instep {

/// Whether a patch spans a hole that its noisy points on the rims leave open: a wider one, of more
/// points, tells what is in it. One just wide enough to meet both rims bulged 17 mm over a gap of
/// 15 mm, and a girth was 4 mm too long.
///
/// `patch`: a HeightPatch of some of the `points`; `nearest`: from its centre to the nearest of
/// them. What exact points leave open does not count. O(members + samples^2) over a hole, else
/// O(1).
bool is_open(const SurfacePatch& patch, double nearest, const std::vector<OrientedPoint>& points);

}  // namespace instep
