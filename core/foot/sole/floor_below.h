#pragma once

#include <optional>
#include <vector>

#include "core/foot/foot_scan.h"

namespace instep {

/// How much deeper the floor lies than the lowest skin of a foot whose sole was not seen, told by
/// how far its walls have bent under where they end: a sole's edge is round, so that skin that
/// leans in by much is near the floor and an upright wall far from it. Skin whose normal dips below
/// the horizon by an angle of sine s is taken to be 11 mm (1 - s) over it, at full size
/// (full_size_factor()). Under two scanned feet, cut off 0.5 to 8 mm over the floor, that was 0.4
/// mm too deep to a quarter too high; the interval, half of it, allows for edges that bend twice as
/// sharply. Zero of a floor that is known.
///
/// Nothing where the border of the foot has not begun to bend under: then the floor lies anywhere
/// below, and the foot's border with it, which is furthest out 10 to 15 mm over the floor. Points
/// over 4 mm apart blur that: so few tell it only of feet cut off far higher.
///
/// `foot` is in its own frame, stands on its lowest points and has its ends. O(n log n) of what is
/// low, at most 20,000 points.
std::optional<FloorBelow> floor_below(const FootScan& foot);

/// The landmarks as they would be if the floor were as much deeper as FootScan::floor_below leaves
/// open; none where that is nothing. Once more the cost of the landmarks, without redraws.
std::vector<RedrawnLandmarks> if_deeper(const FootScan& foot);

}  // namespace instep
