#pragma once

#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points lie off the skin that those round them make: further from the plane of their twelve
/// nearest than a quarter of `spacing`, and than six times what those mostly are (a crease, a rim
/// and noise spread all of them). Where strays fly about, some end so near to the skin that they do
/// not stand alone (stray_points()); a surface that goes through them is dented. Asks several
/// times, without those found before, for one may hide another.
///
/// `spacing` > 0: of most points. A tip as narrow as a few points is taken for one of them: ask
/// only where there are strays. O(n log n).
std::vector<bool> off_skin_points(const PointIndex& index, double spacing);

}  // namespace instep
