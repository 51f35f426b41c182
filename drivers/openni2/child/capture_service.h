#pragma once

#include "drivers/files/descriptor.h"
#include "drivers/files/wake_up.h"
#include "drivers/openni2/frame_ring.h"
#include "drivers/openni2/openni_child.h"

namespace instep {

/// Reads one sensor for the process at the other end of `connection`: opens it, says so, and then
/// does as it is told until that process says so or ends. Frames go into `ring`, and `arrival` is
/// set for each. Gives the exit code; what went wrong has been said before.
///
/// A thread beside it ends the process when the other one has ended, even if the library hangs.
int serve_captures(const SensorChoice& choice, FrameRing& ring, const WakeUp& arrival,
                   const Descriptor& connection);

}  // namespace instep
