#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "config/measuring_settings.h"
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

/// What a person or a program is to measure by who needs no station: [measures] and [sizes] of the
/// settings, whatever is wrong with the rest; the defaults where there is no file. Where the two
/// are unsound it fails if somebody named the file in INSTEP_CONFIG, who wants its definitions and
/// no others; one that merely lies on this machine holds up no measuring: a warning on stderr says
/// so, and the defaults count. Every measure says its definition.
Result<MeasuringSettings> measuring_settings();

/// For whoever only talks to a daemon: the defaults (and the environment) where there is no sound
/// file: enough to reach a daemon. Poses are the settings' own.
Settings station_settings();

/// Why station_settings() went without the file that there is, so that the daemon may be elsewhere
/// than it says; nothing if it took it, or if there is none.
std::optional<Error> passed_over_settings();

}  // namespace instep
