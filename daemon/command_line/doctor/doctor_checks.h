#pragma once

#include <optional>
#include <vector>

#include "config/calibration/warnings_of_poses.h"
#include "config/settings.h"
#include "daemon/command_line/doctor/doctor_check.h"

namespace instep {

/// Whether the real cameras stand where a calibration found them. Bad for those that it left out,
/// for those placed by tape measure alone, and where the station is another than was calibrated:
/// `told` are serial numbers as cameras tell them. Several cameras that stand as the settings say
/// may do so rightly, which is good, with a word. Nothing where there is nothing to calibrate: no
/// real camera, or a single one that stands as the settings say.
std::optional<DoctorCheck> check_calibration(const Settings& settings, const ToldSerials& told);

/// Looks at this machine: settings, results' folder, daemon, cameras, pedal, libraries. Changes
/// nothing. Takes up to some seconds: if no daemon runs, the cameras are opened.
std::vector<DoctorCheck> examine_machine();

}  // namespace instep
