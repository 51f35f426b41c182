#pragma once

#include <chrono>
#include <functional>
#include <vector>

#include "config/devices/output_settings.h"
#include "core/result.h"
#include "daemon/command_line/doctor/daemon_checks.h"
#include "daemon/station/output_keeper.h"

namespace instep {

/// Looks for each lamp and the projector by `look`, all at once and on threads of their own: one
/// whose driver hangs longer than `patience` does not answer, and is left behind.
using LookForOutput = std::function<Result<void>(const GpioOutputSettings&)>;
std::vector<OutputFinding> look_for_outputs(
    const OutputSettings& outputs, const LookForOutput& look,
    std::chrono::milliseconds patience = OutputKeeper::Pace().patience);

}  // namespace instep
