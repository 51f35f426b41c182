#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// The calibration lies in the folder of the settings, under this name.
inline constexpr const char* kCalibrationFileName = "calibration.toml";

inline constexpr std::size_t kMostCalibratedCameras = 16;

struct CalibratedCamera {
  std::string name;  ///< as the settings call it; 1 to 64 characters
  RigidTransform station_from_camera = RigidTransform::Identity();
  /// Of the very unit that stood there, at most 64 characters; empty where it told none.
  std::string serial{};
  /// The pose of the settings that the search began from.
  std::optional<RigidTransform> began_from{};
};

/// Where `instep calibrate` found the real cameras of a station. All poses are of one frame, so
/// that they are right with each other; a pose from elsewhere is not. What they were found from is
/// kept beside them, so that a station that is another since can be told: files of version 1, which
/// say no version, have none of it.
struct StationCalibration {
  std::string time;                       ///< UTC by ISO 8601, such as 2026-11-28T02:11:12Z
  std::vector<CalibratedCamera> cameras;  ///< 1 to kMostCalibratedCameras, no two of one name
  /// z of the standing surface, which the poses were fitted to.
  std::optional<double> platform_height_mm{};
};

/// Where the calibration of these settings lies, if there is one: an absolute path, if the
/// folder that the program runs in is there.
std::filesystem::path calibration_beside(const std::filesystem::path& settings_file);

/// The text of the file; of version 1 where the calibration lacks what version 2 has to say. Read
/// again, every pose is the same to the last bit.
std::string calibration_toml(const StationCalibration& calibration);

/// Reads that text, as strictly as settings are read. Fails with kInvalidInput, every fault in the
/// message as "file:line: what is wrong": an unknown key, a wrong type, what is missing, a time of
/// another form, a pose that is none (pose_matrix.h), two cameras of one name, none or too many, a
/// version that is not known yet.
/// Never throws, never touches the disk.
Result<StationCalibration> read_calibration(std::string_view toml,
                                            const std::filesystem::path& file);

}  // namespace instep
