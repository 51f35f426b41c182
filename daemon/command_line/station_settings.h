#pragma once

#include <filesystem>
#include <string>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// The file of the settings that the daemon of this machine has, as far as the command line can
/// tell: the same search, the same environment. Fails as find_settings() does.
Result<std::filesystem::path> find_station_settings_file();

/// The settings that it has, with its cameras where the calibration puts them.
struct FoundSettings {
  std::filesystem::path file;
  Settings settings;
};
Result<FoundSettings> find_station_settings();

/// The same with the settings' own poses: for whoever opens no camera, whom a faulty calibration is
/// not to stop.
Result<FoundSettings> find_uncalibrated_station_settings();

/// What a person or a program is to measure by: the defaults only where there is no file at all.
/// One that is named or found but unsound fails, as its definitions may be others than the
/// defaults'. Poses are the settings' own.
Result<Settings> measuring_settings();

/// For whoever only talks to a daemon: the defaults (and the environment) where there is no sound
/// file: enough to reach a daemon. Poses are the settings' own.
Settings station_settings();

}  // namespace instep
