#pragma once

#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points hover over a skin: points that stand far apart, with the nearest of those that
/// stand close together straight below. So do strays that have others of their kind for neighbours
/// and thus do not stand alone (stray_points()). The sparse part of a skin lies beside its dense
/// part and does not hover; a second body does, if it is seen with far fewer points and lies within
/// four of their spacings.
///
/// `spacing` > 0: of most points. Those found make others stand further apart: to be asked again
/// without them. O(n log n).
std::vector<bool> hovering_points(const PointIndex& index, double spacing);

}  // namespace instep
