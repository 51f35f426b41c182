#pragma once

#include "core/girth/band/plane_band.h"
#include "core/result.h"

namespace instep {

/// The widest side from which no point near the tape plane is seen out of the middle of them all:
/// what is missing of a section that does not close, or what is widest of one that has points all
/// round.
struct UnseenSide {
  double angle = 0.0;   ///< from the middle (radians), up to a whole turn
  double across = 0.0;  ///< from the one end to the other, straight, in the band's unit
};

/// Of a band with a point at least. O(n log n).
UnseenSide widest_unseen_side(const PlaneBand& band);

/// Why there is no girth, of points round which no loop closes: how much of it none of them shows.
tl::unexpected<Error> does_not_close(const PlaneBand& band);

}  // namespace instep
