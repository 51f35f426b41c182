#pragma once

#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points fill space, as scattered light does, instead of lying on a skin: points that stand
/// further apart than most, and with their twelve nearest spread across their plane by more than a
/// third of what they do along it, the more so where noise spreads all of them. Such haze has
/// others of its kind for neighbours, so that none of it stands alone (stray_points()), and if it
/// is as dense as the skin nearly, no clearly denser skin lies below (hovering_points()).
///
/// Nearly all of its points; some of the rest stand alone then or hover. None where they are fewer
/// than 50 or half a percent: narrow parts of a skin that few points show look alike. Haze as dense
/// as the skin is not told from it. Asks some 2,000 points where there is none, else all up to six
/// times, each O(n log n).
std::vector<bool> haze_points(const PointIndex& index);

}  // namespace instep
