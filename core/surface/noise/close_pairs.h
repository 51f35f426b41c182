#pragma once

#include <vector>

#include "core/geometry/point_index.h"
#include "core/surface/oriented_point.h"

namespace instep {

/// Whether points that lie close together scatter as if `sigma` were noise. What little noise a
/// likelihood finds may be shape that bends at the points' own scale, as the facets of a mesh do:
/// what two points of one facet differ by over their normals falls with their distance, and noise
/// does not. So between nearest neighbours noise makes the steeper slopes the nearer they lie,
/// which a rank correlation shows whatever slopes there are besides.
///
/// False where so few lie close that nobody can tell, as of points spread evenly. `index`: of the
/// points, in their order, with `spacing` > 0 between them as a rule; normals may be anybody's.
/// O(two thousand nearest neighbours).
bool is_noise_between_pairs(const std::vector<OrientedPoint>& points, const PointIndex& index,
                            double spacing, double sigma);

}  // namespace instep
