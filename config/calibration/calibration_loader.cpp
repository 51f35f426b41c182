#include "config/calibration/calibration_loader.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "config/calibration/calibration_file.h"
#include "config/reading/settings_text.h"

namespace instep {
namespace {

const CalibratedCamera* find_camera(const StationCalibration& calibration,
                                    const std::string& name) {
  const auto found = std::find_if(calibration.cameras.begin(), calibration.cameras.end(),
                                  [&](const auto& camera) { return camera.name == name; });
  return found == calibration.cameras.end() ? nullptr : &*found;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr const char* kStartAnew = "delete it and run instep calibrate again";

Result<std::string> read_text(const std::filesystem::path& file) {
  std::error_code failed;
  const auto kind = std::filesystem::status(file, failed).type();
  using Kind = std::filesystem::file_type;
  if (kind == Kind::not_found || failed == std::errc::too_many_symbolic_link_levels) {
    return fail(ErrorCode::kNotFound,
                "the calibration " + file.string() + " is a link that leads nowhere", kStartAnew);
  }
  // A pipe would keep its reader waiting.
  if (kind != Kind::regular && kind != Kind::none) {
    return fail(ErrorCode::kInvalidInput, "the calibration " + file.string() + " is no file",
                std::string("see what it is, or ") + kStartAnew);
  }
  return read_settings_text(file, "calibration file").map_error([](Error error) {
    error.advice += std::string(", or ") + kStartAnew;
    return error;
  });
}

/// But for the rounding on the way from the settings through a recording.
bool is_same(const RigidTransform& one, const RigidTransform& other) {
  constexpr double kRounding_mm = 1e-6;
  constexpr double kRounding = 1e-9;
  const auto apart = [](const auto& a, const auto& b) { return (a - b).cwiseAbs().maxCoeff(); };
  return apart(one.translation(), other.translation()) < kRounding_mm &&
         apart(one.linear(), other.linear()) < kRounding;
}

/// Puts the cameras where it has those of the same name.
void apply(const StationCalibration& calibration, const std::filesystem::path& file,
           Settings& settings) {
  AppliedCalibration applied{file, calibration.time, {}, {}, {}};
  applied.platform_height_mm = calibration.platform_height_mm;
  for (auto& camera : settings.cameras) {
    CameraPlacement* placement = camera.placement();
    if (placement == nullptr) continue;
    const CalibratedCamera* found = find_camera(calibration, placement->name);
    (found == nullptr ? applied.left_out : applied.placed).push_back(placement->name);
    if (found == nullptr) continue;
    if (!found->serial.empty()) applied.serials[placement->name] = found->serial;
    if (found->began_from && !is_same(*found->began_from, placement->station_from_camera)) {
      applied.moved.push_back(placement->name);
    }
    placement->station_from_camera = found->station_from_camera;
    placement->is_rough = false;
  }
  for (const auto& camera : calibration.cameras) {
    if (!is_among(applied.placed, camera.name)) applied.unknown.push_back(camera.name);
  }
  settings.calibration = std::move(applied);
}

}  // namespace

Result<Settings> with_calibration_beside(const std::filesystem::path& settings_file,
                                         Settings settings) {
  const auto file = calibration_beside(settings_file);
  std::error_code failed;
  // A link that leads nowhere is a calibration that got lost, not none.
  const auto entry = std::filesystem::symlink_status(file, failed);
  if (entry.type() == std::filesystem::file_type::not_found) return settings;
  auto calibration = read_text(file).and_then(
      [&](const std::string& text) { return read_calibration(text, file); });
  if (!calibration) return tl::make_unexpected(calibration.error());
  apply(*calibration, file, settings);
  return settings;
}

}  // namespace instep
