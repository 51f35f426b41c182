#include "config/calibration/warnings_of_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/calibration/source_of_poses.h"

namespace instep {
namespace {

constexpr const char* kRemedy = "run instep calibrate again, then restart instepd";

const std::string& serial_in_settings(const CameraSettings& camera) {
  return camera.kind == CameraKind::kV4l2 ? camera.v4l2.serial : camera.openni.serial;
}

std::string serial_of(const CameraSettings& camera, const ToldSerials& told) {
  const std::string& in_settings = serial_in_settings(camera);
  if (!in_settings.empty()) return in_settings;
  const auto own = told.find(camera.placement()->name);
  return own == told.end() ? std::string() : own->second;
}

void add_swapped(const Settings& settings, const ToldSerials& told,
                 std::vector<std::string>& changes) {
  for (const auto& camera : settings.cameras) {
    if (camera.placement() == nullptr) continue;
    const std::string& name = camera.placement()->name;
    const auto calibrated = settings.calibration->serials.find(name);
    if (calibrated == settings.calibration->serials.end()) continue;
    const std::string serial = serial_of(camera, told);
    if (serial.empty() || serial == calibrated->second) continue;
    changes.push_back(
        fmt::format("{} is the unit {}, and {} was calibrated", name, serial, calibrated->second));
  }
}

/// Where the settings say nothing a calibration takes 0.
void add_height(const Settings& settings, std::vector<std::string>& changes) {
  constexpr double kRounding_mm = 1e-6;
  const auto& calibrated_mm = settings.calibration->platform_height_mm;
  const double now_mm = settings.station.platform_height_mm.value_or(0.0);
  if (!calibrated_mm || std::abs(now_mm - *calibrated_mm) < kRounding_mm) return;
  changes.push_back(
      fmt::format("station.platform_height_mm is {}, and was {} when the cameras were "
                  "calibrated",
                  now_mm, *calibrated_mm));
}

}  // namespace

std::vector<std::string> what_has_changed(const Settings& settings, const ToldSerials& told) {
  std::vector<std::string> changes;
  if (!settings.calibration || settings.calibration->placed.empty()) return changes;
  add_swapped(settings, told, changes);
  for (const auto& name : settings.calibration->moved) {
    changes.push_back(
        fmt::format("{} stands elsewhere by the settings than when it was calibrated", name));
  }
  add_height(settings, changes);
  return changes;
}

std::vector<std::string> warnings_of_poses(const Settings& settings, const ToldSerials& told) {
  std::vector<std::string> warnings;
  if (auto by_tape = warning_of_tape_measure(settings); !by_tape.empty()) {
    warnings.push_back(std::move(by_tape));
  }
  const std::string lacking = settings.calibration ? what_is_lacking(*settings.calibration) : "";
  if (!lacking.empty()) warnings.push_back(fmt::format("{}: {}", lacking, kRemedy));
  for (const auto& change : what_has_changed(settings, told)) {
    warnings.push_back(fmt::format("{}, which makes measures wrong: {}", change, kRemedy));
  }
  return warnings;
}

}  // namespace instep
