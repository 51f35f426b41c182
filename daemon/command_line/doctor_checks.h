#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "config/warnings_of_poses.h"
#include "core/result.h"

namespace instep {

/// One thing that a station needs, whether it is there, and the command that brings it.
struct DoctorCheck {
  std::string name;
  bool good = true;
  std::string finding;
  std::string remedy;  ///< empty if good
};

/// Whether the real cameras stand where a calibration found them. Bad for those that it left out,
/// for those placed by tape measure alone, and where the station is another than was calibrated:
/// `told` are serial numbers as cameras tell them. Several cameras that stand as the settings say
/// may do so rightly, which is good, with a word. Nothing where there is nothing to calibrate: no
/// real camera, or a single one that stands as the settings say.
std::optional<DoctorCheck> check_calibration(const Settings& settings, const ToldSerials& told);

/// Whether the user that `daemon` runs as can keep results there; without one, by whose the folder
/// is.
DoctorCheck check_store(const std::filesystem::path& root, std::optional<uid_t> daemon);

/// What the daemon that gave this status tells of its store, which need not be the one that the
/// settings name by now; else as check_store() finds `root`.
DoctorCheck check_store_of(const nlohmann::json& status, const std::filesystem::path& root,
                           std::optional<uid_t> daemon);

/// What the daemon that gave this status tells of its pedal; nothing if it tells of none.
std::optional<DoctorCheck> check_pedal_of(const nlohmann::json& status);

/// Whether a daemon answers and all is well with it.
DoctorCheck check_daemon(const Result<nlohmann::json>& status, const std::filesystem::path& socket);

/// Looks at this machine: settings, results' folder, daemon, cameras, pedal, libraries. Changes
/// nothing. Takes up to some seconds: if no daemon runs, the cameras are opened.
std::vector<DoctorCheck> examine_machine();

}  // namespace instep
