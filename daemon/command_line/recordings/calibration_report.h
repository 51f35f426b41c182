#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fusion/poses/find_poses.h"

namespace instep {

/// What comes of the poses that were found.
enum class PosesUse {
  kPrinted,     ///< of a recording, for which nobody named a file
  kNeedless,    ///< of simulated or recorded cameras of a station, which bring their own
  kOfStation,   ///< written to where the station takes them from
  kInFile,      ///< written to a file that somebody named
  kNotWritten,  ///< could not be written
};

/// Where the cameras of a station were found to stand.
struct CalibrationReport {
  std::vector<std::string> names;  ///< of the cameras, as FoundPoses::cameras
  FoundPoses poses;
  std::optional<std::filesystem::path> file;  ///< that holds them now
  PosesUse use = PosesUse::kPrinted;
};

nlohmann::ordered_json to_json(const CalibrationReport& report);

/// A table for people, and what to do next.
std::string to_text(const CalibrationReport& report);

}  // namespace instep
