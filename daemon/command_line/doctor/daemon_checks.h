#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "daemon/command_line/doctor/doctor_check.h"
#include "daemon/machine/device_checks.h"

namespace instep {

/// What the doctor makes of a daemon's answer to "status". What is wrong with a part of the station
/// is told once, by the check of that part, with the daemon's own advice as the remedy.

/// Whether a daemon answers, and what is wrong with it that no part of it tells.
DoctorCheck check_daemon(const Result<nlohmann::json>& status, const std::filesystem::path& socket);

/// What the daemon tells of its store, which need not be the one that the settings name by now;
/// else as check_store() finds `root`.
DoctorCheck check_store_of(const nlohmann::json& status, const std::filesystem::path& root,
                           std::optional<uid_t> daemon);

/// Nothing if it tells of no pedal.
std::optional<DoctorCheck> check_pedal_of(const nlohmann::json& status);

/// The video cameras of the settings by their names, and what each lacks as the kernel's folders
/// show it.
using VideoTroubles = std::map<std::string, std::optional<DeviceTrouble>>;

/// Of a station that has no camera, and nobody says why.
DoctorCheck no_cameras();

/// One for each camera that does not answer, but for those whose cause the kernel's folders show,
/// of which check_video_cameras() tells; one for all if they answer.
std::vector<DoctorCheck> check_cameras_of(const nlohmann::json& status, const VideoTroubles& video);

/// Those of which the kernel's folders tell whoever asks more than the daemon does: not a camera
/// that they may not open, and the daemon has.
VideoTroubles without_those_of(const nlohmann::json& status, VideoTroubles video);

/// One for each of them. `daemon`: whom it runs as, if it answers.
std::vector<DoctorCheck> check_video_cameras(const VideoTroubles& video,
                                             std::optional<uid_t> daemon);

/// A lamp or a projector, and what is wrong with it.
struct OutputFinding {
  std::string name;
  std::string trouble;  ///< empty if it is there
  std::string remedy;
  bool is_closed = false;  ///< it is that whoever asks may not open it
};

/// As the daemon tells them.
std::vector<OutputFinding> outputs_of(const nlohmann::json& status);

/// One for each that is there, and one for all that are away for the same cause. `there`: how it is
/// said that one is.
std::vector<DoctorCheck> check_outputs(const std::vector<OutputFinding>& outputs,
                                       const char* there);

}  // namespace instep
