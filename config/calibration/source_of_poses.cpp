#include "config/calibration/source_of_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace instep {
namespace {

using Names = std::vector<std::string>;

/// The real cameras, by where their poses come from.
struct NamesBySource {
  Names calibrated;
  Names by_settings;
  Names by_tape;
};

NamesBySource names_by_source(const Settings& settings) {
  NamesBySource names;
  if (settings.calibration) names.calibrated = settings.calibration->placed;
  for (const auto& camera : settings.cameras) {
    const CameraPlacement* placement = camera.placement();
    if (placement == nullptr) continue;
    const auto& calibrated = names.calibrated;
    const bool is_calibrated =
        std::find(calibrated.begin(), calibrated.end(), placement->name) != calibrated.end();
    if (is_calibrated) continue;
    (placement->is_rough ? names.by_tape : names.by_settings).push_back(placement->name);
  }
  return names;
}

}  // namespace

std::string source_of_poses(const Settings& settings) {
  const auto names = names_by_source(settings);
  const std::string when = settings.calibration ? settings.calibration->time : "";
  const std::pair<const Names&, std::string> sources[] = {
      {names.calibrated, "instep calibrate, " + when},
      {names.by_settings, "as the settings say"},
      {names.by_tape, "by tape measure"}};
  std::string text;
  for (const auto& [cameras, source] : sources) {
    if (cameras.empty()) continue;
    text += text.empty() ? source : fmt::format("; {} {}", fmt::join(cameras, ", "), source);
  }
  return text;
}

std::string warning_of_tape_measure(const Settings& settings) {
  const auto names = names_by_source(settings).by_tape;
  if (names.empty()) return "";
  return fmt::format(
      "placed by tape measure alone, which makes measures wrong, by up to decimetres: {}: run "
      "instep "
      "calibrate, then restart instepd",
      fmt::join(names, ", "));
}

}  // namespace instep
