#pragma once

#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// Whether points that lie close together scatter as if `sigma` were noise. What little noise a
/// likelihood finds may be shape that bends at the points' own scale, as the facets of a mesh do:
/// between two points of one facet that vanishes with their distance, and noise does not. By the
/// variogram of the heights of nearest neighbours, a constant (noise) and the square of the
/// distance (slopes that the normals do not know), by maximum likelihood.
///
/// False where so few lie close that nobody can tell, as of points spread evenly. `index`: of the
/// points, in their order, with `spacing` > 0 between them as a rule; normals may be anybody's.
/// O(two thousand nearest neighbours).
bool is_noise_between_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                            double spacing, double sigma);

}  // namespace instep
