#pragma once

#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// The girth of a body that stands on z = 0, from its girth as fitted: nothing of it lies below the
/// platform. A fitted surface dips there by some tenths of a millimetre, where it turns from a wall
/// that was seen into the sole that was not. The section is cut at z = 0, and both lengths change
/// by what that takes off or adds. Foot frame.
Girth standing_girth(Girth fitted, const TapePlane& plane);

}  // namespace instep
