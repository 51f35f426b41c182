#pragma once

#include <chrono>

#include "daemon/command_line/doctor/doctor_check.h"
#include "daemon/station/pedal_watch.h"

namespace instep {

/// Whether the pedal can be opened, read and closed again, by what the daemon does with it. One
/// that hangs longer than `patience` does not answer, and is left behind.
DoctorCheck check_pedal(const PedalSettings& settings, const PedalWatch::Open& open,
                        std::chrono::milliseconds patience = PedalWatch::kPatience);

}  // namespace instep
