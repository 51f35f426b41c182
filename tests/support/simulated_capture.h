#pragma once

#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"

namespace instep::test {

/// What the cameras of a simulated station bring in at one press of the pedal, 15 frames each.
/// Fails as they do.
Result<Capture> capture_of(SimulatedStation& station);

}  // namespace instep::test
