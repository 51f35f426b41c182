#pragma once

#include <cstddef>
#include <string>

namespace instep {

/// The property of PointCloud::shared_errors_mm[index]; files count from 1.
inline std::string shared_error_property(std::size_t index) {
  return "shared_error_" + std::to_string(index + 1) + "_mm";
}

/// The properties of PointCloud::local_errors: of each point its own, and the reach, which is the
/// same of all.
inline constexpr const char* kLocalErrorProperty = "local_error_mm";
inline constexpr const char* kLocalErrorReachProperty = "local_error_reach_mm";

/// Of noise whose unit nobody told, so that it is not used.
inline constexpr const char* kNoiseWithoutUnit = "sigma";
inline constexpr const char* kNoteOfNoiseWithoutUnit =
    "the column sigma was not used, for its unit is not told: if it is the noise of each point in "
    "mm, name it sigma_mm";

}  // namespace instep
