#pragma once

#include <map>
#include <string>
#include <vector>

#include "config/settings.h"

namespace instep {

/// Serial numbers as the cameras themselves tell them, by name.
using ToldSerials = std::map<std::string, std::string>;

/// In what the station is another than the one that was calibrated, a sentence each: a unit that
/// was swapped, a camera that the settings have elsewhere since, another height of the platform.
/// Units are known by the serial number in the settings; of those that have none there, by what
/// they told.
std::vector<std::string> what_has_changed(const Settings& settings, const ToldSerials& told);

/// All that makes measures wrong, and that a scan alone cannot always tell, of where the real
/// cameras stand: placed by a tape alone, left out by the calibration, or calibrated as another
/// station. Each is a line that says what to do; none if all is well.
std::vector<std::string> warnings_of_poses(const Settings& settings, const ToldSerials& told);

}  // namespace instep
