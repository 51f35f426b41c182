#pragma once

#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points hover over a skin: points that stand far apart, with the nearest of those that
/// stand close together straight below, no further than four of their spacings. So do strays that
/// have others of their kind for neighbours and thus do not stand alone (stray_points()). A sparse
/// sheet does not hover, be it a part of the skin or of another body: its points have others beside
/// them, flat. Of a sheet so sparse that it bends from point to point some may be taken for
/// hovering.
///
/// `spacing` > 0: of most points. None where fewer than a dozen stand close together, or where over
/// a fifth stand far apart: these are another skin, if a noisy one. O(n log n).
std::vector<bool> hovering_points(const PointIndex& index, double spacing);

}  // namespace instep
