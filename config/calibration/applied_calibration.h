#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace instep {

/// What a calibration file that lies beside the settings did to them. Cameras are named, in the
/// order of their file.
struct AppliedCalibration {
  std::filesystem::path file;
  std::string time;                 ///< StationCalibration::time
  std::vector<std::string> placed;  ///< real cameras of the settings that stand as it says
  /// Real cameras of the settings that it does not hold. They stand as the settings say, which is
  /// in another frame than the calibrated ones: worth a warning.
  std::vector<std::string> left_out;
  std::vector<std::string> unknown;  ///< cameras that it holds and the settings do not
  /// Of the placed cameras those whose pose in the settings is not the one that it was found from.
  std::vector<std::string> moved{};
  std::map<std::string, std::string> serials{};  ///< of the placed units, by camera, where it tells
  std::optional<double> platform_height_mm{};    ///< StationCalibration::platform_height_mm
};

/// The lines of `instepd --check` say it so.
std::string describe(const AppliedCalibration& calibration);

/// Which real cameras the calibration lacks, as a sentence that names its file; empty if none.
std::string what_is_lacking(const AppliedCalibration& calibration);

}  // namespace instep
