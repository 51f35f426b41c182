#include "config/settings_description.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "config/calibration/warnings_of_poses.h"

namespace instep {
namespace {

using Eigen::Vector3d;

std::string describe_station(const StationSettings& station) {
  return fmt::format(
      "station  {}, points every {} mm, side {}\nstation  {}, {}\n", station.name,
      station.point_spacing_mm, station.side ? to_string(*station.side) : "told from the shape",
      station.platform_height_mm ? fmt::format("platform at {} mm", *station.platform_height_mm)
                                 : "platform as the cameras say",
      station.refine_views ? "views are fitted to each other" : "poses and lenses are trusted");
}

std::string describe_simulation(const SimulatedStationSettings& simulation) {
  const char* noise = simulation.noise == SimulatedNoise::kNone      ? "no"
                      : simulation.noise == SimulatedNoise::kTypical ? "typical"
                                                                     : "pessimistic";
  return fmt::format(
      "{} simulated, {} x {} px, {} noise, {}", simulation.cameras, simulation.width_px,
      simulation.height_px, noise,
      simulation.pacing == SimulatedPacing::kRealTime ? "in real time" : "as fast as they can");
}

std::string describe_subject(const SimulatedStationSettings& simulation) {
  const auto body = [&]() -> std::string {
    switch (simulation.subject) {
      case SimulatedSubject::kFoot:
        return std::string("the ") + to_string(simulation.side) + " foot";
      case SimulatedSubject::kFeet:
        return "both feet";
      case SimulatedSubject::kCylinder:
        return "a cylinder";
      case SimulatedSubject::kLast:
        return "a last";
    }
    return "";
  };
  return fmt::format("subject  {} of seed {}, its truth {}\n", body(), simulation.seed,
                     simulation.truth ? "beside the measures" : "is not told");
}

std::string describe_camera(const CameraSettings& camera,
                            const SimulatedStationSettings& simulation) {
  switch (camera.kind) {
    case CameraKind::kRecording:
      return "the recording " + camera.path.string();
    case CameraKind::kOpenni:
      return describe(camera.openni);
    case CameraKind::kV4l2:
      return describe(camera.v4l2);
    case CameraKind::kSimulated:
      return describe_simulation(simulation);
  }
  return "";
}

/// With so many digits behind the point, and without a zero that is negative.
std::string triple(const Vector3d& vector, int digits) {
  const double unit = std::pow(10.0, -digits);
  const auto rounded = [&](double number) { return std::round(number / unit) * unit + 0.0; };
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", rounded(vector.x()), digits,
                     rounded(vector.y()), digits, rounded(vector.z()), digits);
}

/// Where a real camera stands for a scan: as calibrated, or as the settings say.
std::string describe_pose(const CameraPlacement& placement) {
  const auto& pose = placement.station_from_camera;
  return fmt::format("pose     {} at {} mm, looks along {}, the top of its image along {}\n",
                     placement.name, triple(pose.translation(), 1), triple(pose.linear().col(2), 3),
                     triple(-pose.linear().col(1), 3));
}

std::string describe_lens(const CameraPlacement& placement) {
  const auto& lens = *placement.intrinsics;
  return fmt::format("lens     {} with {} x {} px, f {}, {} px, centre {}, {} px, distortion {}\n",
                     placement.name, lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy,
                     fmt::join(lens.distortion, ", "));
}

std::string describe_cameras(const Settings& settings) {
  std::string text;
  for (const auto& camera : settings.cameras) {
    const bool is_rough = camera.placement() != nullptr && camera.placement()->is_rough;
    text += fmt::format("cameras  {}{}\n", describe_camera(camera, settings.simulation),
                        is_rough ? ", placed by tape measure" : "");
  }
  for (const auto& camera : settings.cameras) {
    if (camera.kind == CameraKind::kSimulated) text += describe_subject(settings.simulation);
    const CameraPlacement* placement = camera.placement();
    if (placement == nullptr) continue;
    text += describe_pose(*placement);
    if (placement->intrinsics) text += describe_lens(*placement);
  }
  return text;
}

std::string describe_capture(const CaptureSettings& capture) {
  return fmt::format(
      "capture  {} frames of each camera after {} to warm up, within {} ms\n"
      "capture  {}, each frame within {} ms; idle cameras are looked at every {} s\n",
      capture.frames_per_camera, capture.warmup_frames, capture.deadline.count(),
      capture.one_at_a_time ? "one camera at a time" : "all cameras at once",
      capture.frame_limit.count(), capture.check_every.count());
}

std::string describe_pedal(const PedalSettings& pedal) {
  const std::string times =
      fmt::format("pedal    it bounces for {} ms at most; held for {} ms it cancels a scan\n",
                  pedal.debounce.count(), pedal.hold_to_cancel.count());
  switch (pedal.kind) {
    case PedalKind::kNone:
      return "pedal    none\n";
    case PedalKind::kSimulated:
      return "pedal    simulated, taps are written to " + pedal.fifo.string() + "\n" + times;
    case PedalKind::kGpio:
      return "pedal    " + describe(pedal.gpio) + "\n" + times;
    case PedalKind::kEvdev:
      return "pedal    " + describe(pedal.evdev) + "\n" + times;
  }
  return "";
}

/// Only what is simulated has faults on command.
std::string describe_faults(const Settings& settings) {
  const auto& script = settings.simulation.fault_script;
  if (!settings.has_simulated_parts() || script.empty()) return "";
  return "faults   on command of " + script.string() + "\n";
}

std::string describe_keeping(const StoreSettings& store) {
  std::string text;
  if (store.keep_days > 0) text += fmt::format(", kept for {} days", store.keep_days);
  if (store.keep_count > 0) text += fmt::format(", at most {}", store.keep_count);
  return text.empty() ? ", kept for ever" : text;
}

std::string describe_row(const ShopSize& row) {
  const std::string girth = row.largest_ball_girth_mm ? fmt::format(" and {} mm round the ball",
                                                                    *row.largest_ball_girth_mm)
                                                      : "";
  return fmt::format("{} up to {} mm{}", row.size, row.longest_foot_mm, girth);
}

std::string describe_sizes(const SizeRules& sizes) {
  std::string text = fmt::format("sizes    lasts {} mm longer than the foot\n", sizes.allowance_mm);
  for (const auto& table : sizes.shop_tables) {
    std::vector<std::string> rows;
    for (const auto& row : table.sizes) rows.push_back(describe_row(row));
    text += fmt::format("sizes    {} with {} sizes: {}\n", table.name, rows.size(),
                        fmt::join(rows, "; "));
  }
  return text;
}

const char* name_of(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return "debug";
    case LogLevel::kInfo:
      return "info";
    case LogLevel::kWarning:
      return "warning";
    case LogLevel::kError:
      return "error";
  }
  return "";
}

}  // namespace

std::string describe(const Settings& settings) {
  std::string text = describe_station(settings.station) + describe_cameras(settings);
  if (settings.calibration) text += describe(*settings.calibration);
  for (const auto& change : what_has_changed(settings, {})) {
    text += fmt::format("poses    {}: run instep calibrate again\n", change);
  }
  text += describe_capture(settings.capture) + describe_pedal(settings.pedal);
  for (const auto& [name, output] : settings.outputs.named()) {
    text += fmt::format("output   {}: {}\n", name, describe(*output));
  }
  text += describe_faults(settings);
  text += fmt::format("store    {}{}\n", settings.store.root.string(),
                      describe_keeping(settings.store));
  text += fmt::format("measures {}\n", in_words(settings.measures));
  text += describe_sizes(settings.sizes);
  text += fmt::format("control  {}\n", settings.control.socket.string());
  return text + fmt::format("log      {}\n", name_of(settings.log.level));
}

}  // namespace instep
