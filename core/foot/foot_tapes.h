#pragma once

#include "core/foot/foot_scan.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"

namespace instep {

/// Where the tapes lie on an aligned foot with its landmarks; foot frame. Each fails with
/// kInsufficientData where a landmark it needs was not found.

/// Upright, over metatarsale tibiale and fibulare.
Result<TapePlane> ball_tape(const FootScan& foot);

/// Over the instep point; meets the floor under the lateral midfoot and the medial arch.
Result<TapePlane> instep_tape(const FootScan& foot);

/// Midway between the two: medial, lateral and dorsal control points are averaged. (The ball tape's
/// dorsal one is taken at the height of the instep point.)
Result<TapePlane> waist_tape(const FootScan& foot);

}  // namespace instep
