#pragma once

#include "core/foot/foot_scan.h"
#include "core/girth/tape_plane.h"
#include "core/result.h"

namespace instep {

/// Where the tapes lie on a foot, by its landmarks; in their frame. Each fails with
/// kInsufficientData where a landmark it needs was not found.

/// Upright, over metatarsale tibiale and fibulare.
Result<TapePlane> ball_tape(const Landmarks& landmarks);

/// Over the same two points, leaning forward from them by some degrees.
Result<TapePlane> leaning_ball_tape(const Landmarks& landmarks, double forward_deg);

/// Over the instep point; meets the floor under the lateral midfoot and the medial arch.
Result<TapePlane> instep_tape(const Landmarks& landmarks);

/// Over the instep point, upright and square to the axis.
Result<TapePlane> upright_instep_tape(const Landmarks& landmarks);

/// Midway between ball_tape() and instep_tape(): medial, lateral and dorsal control points are
/// averaged. (The ball tape's dorsal one is taken at the height of the instep point.)
Result<TapePlane> waist_tape(const Landmarks& landmarks);

/// Round the heel point and over the junction of foot and leg, square to the side view.
Result<TapePlane> short_heel_tape(const Landmarks& landmarks);

/// Round the heel point and over the instep point, square to the side view.
Result<TapePlane> long_heel_tape(const Landmarks& landmarks);

/// Level, over the medial malleolus.
Result<TapePlane> ankle_tape(const Landmarks& landmarks);

}  // namespace instep
