#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "core/result.h"

namespace instep {

/// Reads an environment variable; nothing if it is not set or empty. getenv() in the programs.
using Environment = std::function<std::optional<std::string>(const char* name)>;

/// Where settings may lie, so that the programs run installed and from their build folder.
struct SettingsPlaces {
  std::optional<std::filesystem::path> asked;  ///< --config; only this one is then looked at
  std::filesystem::path binary_folder;         ///< of the running program
  std::filesystem::path source_folder;         ///< of the source tree it was built from
};

/// The environment variables that override paths of the settings, for --help.
inline constexpr const char* kEnvironmentHelp =
    "Environment:\n"
    "  INSTEP_CONFIG  settings file, where none is named\n"
    "  INSTEP_STORE   folder of the results   (store.root)\n"
    "  INSTEP_SOCKET  socket of the daemon    (control.socket)\n"
    "  INSTEP_PEDAL   simulated pedal's fifo  (pedal.fifo)\n";

/// The same for commands that need no station, and of its settings [measures] and [sizes] alone.
inline constexpr const char* kMeasuringEnvironmentHelp =
    "The definitions to measure by and the tables of sizes are [measures] and [sizes] of the\n"
    "station's settings, if this machine has any: whatever else is wrong with them does not "
    "matter.\n"
    "Where these two are unsound, a warning says so, and the usual ones count.\n"
    "Environment:\n"
    "  INSTEP_CONFIG  settings file to take them from; it has to be there, and the two sound\n";

/// The places that are searched, in order: --config alone if given, else INSTEP_CONFIG alone, else
/// /etc/instep/instep.toml, ../etc/instep and ../share/instep beside the program, and the source
/// tree's config folder.
std::vector<std::filesystem::path> settings_candidates(const SettingsPlaces& places,
                                                       const Environment& environment);

/// The first of the candidates that exists. Fails with kNotFound, naming all that were tried; with
/// kInvalidInput if it is no file, and with kPermissionDenied if it cannot be seen whether it is.
Result<std::filesystem::path> find_settings(const SettingsPlaces& places,
                                            const Environment& environment);

/// Puts the paths that the environment names over those of the settings; what does not begin at the
/// root begins at the working folder.
void override_paths(Settings& settings, const Environment& environment);

/// getenv() as an Environment.
std::optional<std::string> process_environment(const char* name);

/// The folder of the running program (/proc/self/exe).
std::filesystem::path running_program_folder();

}  // namespace instep
