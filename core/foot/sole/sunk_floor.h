#pragma once

#include "core/foot/foot_scan.h"

namespace instep {

/// What noise over 0.5 mm leaves open of how high the edge of an open sole lies, as half-width of a
/// 95 % interval: its lowest points are those that noise moved down along the wall, where no
/// neighbours show it. Skin that faces up does: the noise of the foot's back is asked, of the
/// noisier side. Where it is along z alone the edge lies about as much too low as this.
///
/// Nothing where the floor is known, the sole was seen, or the cloud is quiet. `foot` is in its own
/// frame. O(n log n): some 30 ms of a noisy cloud.
double sunk_floor_mm(const FootScan& foot);

}  // namespace instep
