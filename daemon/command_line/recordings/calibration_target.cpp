#include "daemon/command_line/recordings/calibration_target.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "config/reading/settings_text.h"
#include "drivers/files/file_bytes.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAsWhoMayWrite = "run it as root, or choose another --out";

Result<void> check_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) {
    return fail(ErrorCode::kNotFound, folder.string() + " is no folder to write poses in",
                "make it, or choose another --out");
  }
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  Error error = file_error(errno, "write in", folder);
  error.advice = kAsWhoMayWrite;
  return tl::make_unexpected(error);
}

/// A file of something else is not lost to a name mistyped.
Result<void> check_is_calibration(const fs::path& file) {
  const auto read = read_settings_text(file, "file").and_then([&](const std::string& text) {
    return read_calibration(text, file);
  });
  if (read) return {};
  return fail(ErrorCode::kInvalidInput,
              file.string() + " holds something else than a calibration, and is not replaced",
              "choose another --out");
}

/// A name that is no UTF-8 comes back as another one.
bool has_same_names(const StationCalibration& one, const StationCalibration& other) {
  return std::equal(one.cameras.begin(), one.cameras.end(), other.cameras.begin(),
                    other.cameras.end(),
                    [](const auto& a, const auto& b) { return a.name == b.name; });
}

}  // namespace

Result<void> check_calibration_target(const CalibrationTarget& target) {
  const fs::path file = target.is_of_station ? end_of_links(target.file) : target.file;
  if (auto folder = check_folder(file); !folder) return folder;
  std::error_code away;
  const auto kind = fs::symlink_status(file, away).type();
  if (kind == fs::file_type::not_found) return {};
  if (kind == fs::file_type::regular) {
    const bool is_stations_own = target.is_of_station && file == target.file;
    return is_stations_own ? Result<void>() : check_is_calibration(file);
  }
  return fail(ErrorCode::kInvalidInput, target.file.string() + " is no regular file",
              "choose another --out");
}

Result<void> write_calibration(const CalibrationTarget& target,
                               const StationCalibration& calibration) {
  const std::string text = calibration_toml(calibration);
  const auto again = read_calibration(text, target.file);
  if (!again || !has_same_names(*again, calibration)) {
    const std::string why = again ? "a camera's name is no text" : again.error().message;
    return fail(ErrorCode::kInvalidInput,
                "nothing is written, for it could not be read again: " + why,
                "leave --out away and take the poses that are printed");
  }
  auto written =
      write_file_bytes(target.file, text, target.is_of_station ? Readers::kAll : Readers::kByUmask);
  if (!written && written.error().code == ErrorCode::kPermissionDenied) {
    written.error().advice = kAsWhoMayWrite;
  }
  return written;
}

}  // namespace instep
