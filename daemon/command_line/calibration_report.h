#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fusion/find_poses.h"

namespace instep {

/// Where the cameras of a station were found to stand.
struct CalibrationReport {
  std::vector<std::string> names;  ///< of the cameras, as FoundPoses::cameras
  FoundPoses poses;
  std::optional<std::filesystem::path> file;  ///< that holds them now
};

nlohmann::ordered_json to_json(const CalibrationReport& report);

/// A table for people, and what to do next.
std::string to_text(const CalibrationReport& report);

}  // namespace instep
