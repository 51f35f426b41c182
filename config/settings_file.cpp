#include "config/settings_file.h"

#include "config/reading/settings_text.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "config/calibration/calibration_loader.h"
#include "config/devices/v4l2_settings_table.h"
#include "config/distinct_cameras.h"
#include "config/measuring_settings.h"
#include "config/reading/settings_table.h"
#include "config/reading/toml_reading.h"

namespace instep {
namespace {

constexpr std::size_t kMostCameraSources = 8;

const SettingsTable::Choices<Side> kSides = {{"left", Side::kLeft}, {"right", Side::kRight}};

void read_station(SettingsTable& table, StationSettings& station) {
  table.read("name", station.name, 64);
  table.read("platform_height_mm", station.platform_height_mm, -1000, 1000);
  table.read("point_spacing_mm", station.point_spacing_mm, 0.2, 10);
  table.read("refine_views", station.refine_views);
  table.choose("side", station.side,
               {{"left", Side::kLeft}, {"right", Side::kRight}, {"auto", std::nullopt}});
}

void read_capture(SettingsTable& table, CaptureSettings& capture) {
  table.read("frames_per_camera", capture.frames_per_camera, 1, 120);
  table.read("warmup_frames", capture.warmup_frames, 0, 120);
  table.read("deadline_ms", capture.deadline, 200, 60000);
  // A silent camera takes no step for so long, and WatchdogSec of the unit is 10 s.
  table.read("frame_limit_ms", capture.frame_limit, 50, 5000);
  table.read("one_at_a_time", capture.one_at_a_time);
  table.read("check_every_s", capture.check_every, 1, 3600);
}

void read_pedal(SettingsTable& table, PedalSettings& pedal, const std::filesystem::path& base,
                SettingsFaults& faults) {
  table.choose("kind", pedal.kind,
               {{"simulated", PedalKind::kSimulated},
                {"none", PedalKind::kNone},
                {"gpio", PedalKind::kGpio},
                {"evdev", PedalKind::kEvdev}});
  table.read("debounce_ms", pedal.debounce, 5, 200);
  table.read("hold_to_cancel_ms", pedal.hold_to_cancel, 500, 10000);
  table.read("fifo", pedal.fifo, base);
  const bool by_gpio = pedal.kind == PedalKind::kGpio;
  const bool by_evdev = pedal.kind == PedalKind::kEvdev;
  read_section(table, "gpio", faults, [&](SettingsTable& gpio) {
    read_gpio_pedal(gpio, pedal.gpio);
    if (by_gpio) require_gpio_place(gpio, faults);
  });
  read_section(table, "evdev", faults, [&](SettingsTable& evdev) {
    read_evdev_pedal(evdev, pedal.evdev);
    if (by_evdev) require_evdev_pedal(evdev, faults);
  });
  if (by_gpio && !table.has("gpio")) faults.add(table.line(), gpio_place_missing("pedal.gpio"));
  if (by_evdev && !table.has("evdev")) faults.add(table.line(), evdev_device_missing());
}

CameraSettings read_camera(SettingsTable& table, const std::filesystem::path& base,
                           SettingsFaults& faults) {
  CameraSettings camera;
  table.choose("kind", camera.kind,
               {{"simulated", CameraKind::kSimulated},
                {"recording", CameraKind::kRecording},
                {"openni2", CameraKind::kOpenni},
                {"v4l2", CameraKind::kV4l2}});
  table.read("path", camera.path, base);
  if (camera.kind == CameraKind::kOpenni) camera.openni = read_openni_settings(table, base, faults);
  if (camera.kind == CameraKind::kRecording && camera.path.empty()) {
    faults.add(table.line(), "camera.path is missing: name the folder of the recording");
  }
  if (camera.kind == CameraKind::kV4l2) camera.v4l2 = read_v4l2_settings(table, faults);
  table.finish();
  return camera;
}

void read_simulation(SettingsTable& table, SimulatedStationSettings& simulation,
                     const std::filesystem::path& base) {
  table.read("seed", simulation.seed);
  table.choose("subject", simulation.subject,
               {{"foot", SimulatedSubject::kFoot},
                {"feet", SimulatedSubject::kFeet},
                {"cylinder", SimulatedSubject::kCylinder},
                {"last", SimulatedSubject::kLast}});
  table.choose("side", simulation.side, kSides);
  table.read("cameras", simulation.cameras, 1, 8);
  table.read("width_px", simulation.width_px, 64, 1280);
  table.read("height_px", simulation.height_px, 48, 960);
  table.choose("noise", simulation.noise,
               {{"none", SimulatedNoise::kNone},
                {"typical", SimulatedNoise::kTypical},
                {"pessimistic", SimulatedNoise::kPessimistic}});
  table.choose(
      "pacing", simulation.pacing,
      {{"real-time", SimulatedPacing::kRealTime}, {"fast", SimulatedPacing::kAsFastAsPossible}});
  table.read("truth", simulation.truth);
  table.read("fault_script", simulation.fault_script, base);
}

void read_store(SettingsTable& table, StoreSettings& store, const std::filesystem::path& base) {
  table.read("root", store.root, base);
  table.read("keep_days", store.keep_days, 0, 36500);
  table.read("keep_count", store.keep_count, 0, 1000000);
}

void read_log(SettingsTable& table, LogSettings& log) {
  table.choose("level", log.level,
               {{"debug", LogLevel::kDebug},
                {"info", LogLevel::kInfo},
                {"warning", LogLevel::kWarning},
                {"error", LogLevel::kError}});
}

void read_cameras(SettingsTable& root, std::vector<CameraSettings>& cameras,
                  const std::filesystem::path& base, SettingsFaults& faults) {
  // One with a fault may look like another only because of it.
  std::vector<CameraSettings> sound;
  std::vector<unsigned> lines;
  for (const toml::table* camera : root.tables("camera")) {
    SettingsTable table(*camera, "camera", faults);
    const auto faults_before = faults.count();
    cameras.push_back(read_camera(table, base, faults));
    if (faults.count() != faults_before) continue;
    sound.push_back(cameras.back());
    lines.push_back(table.line());
  }
  check_distinct_cameras(sound, lines, faults);
  if (cameras.empty()) {
    faults.add(1, "there is no [[camera]]: add one, such as kind = \"simulated\"");
  }
  if (cameras.size() > kMostCameraSources) {
    faults.add(1, fmt::format("there are {} [[camera]] tables, more than {}", cameras.size(),
                              kMostCameraSources));
  }
}

void check_socket(const toml::table& root, const ControlSettings& control, SettingsFaults& faults) {
  constexpr std::size_t kLongestSocketPath = 100;
  if (control.socket.native().size() <= kLongestSocketPath) return;
  faults.add(root["control"]["socket"].node()->source().begin.line,
             fmt::format("control.socket is longer than {} characters, the most that a Unix socket "
                         "can be called",
                         kLongestSocketPath));
}

void read_all(const toml::table& toml, const std::filesystem::path& base, Settings& settings,
              SettingsFaults& faults) {
  using Table = SettingsTable;
  Table root(toml, "", faults);
  read_section(root, "station", faults,
               [&](Table& table) { read_station(table, settings.station); });
  read_section(root, "capture", faults,
               [&](Table& table) { read_capture(table, settings.capture); });
  const auto faults_before_pedal = faults.count();
  read_section(root, "pedal", faults,
               [&](Table& table) { read_pedal(table, settings.pedal, base, faults); });
  const bool gpio_pedal =
      settings.pedal.kind == PedalKind::kGpio && faults.count() == faults_before_pedal;
  read_outputs(root, settings.outputs, gpio_pedal ? &settings.pedal.gpio.place : nullptr, faults);
  read_section(root, "simulation", faults,
               [&](Table& table) { read_simulation(table, settings.simulation, base); });
  read_section(root, "store", faults,
               [&](Table& table) { read_store(table, settings.store, base); });
  read_measuring(root, settings.measures, settings.sizes, faults);
  read_section(root, "control", faults,
               [&](Table& table) { table.read("socket", settings.control.socket, base); });
  read_section(root, "log", faults, [&](Table& table) { read_log(table, settings.log); });
  read_cameras(root, settings.cameras, base, faults);
  check_socket(toml, settings.control, faults);
  root.finish();
}

}  // namespace

SettingsReading read_settings(std::string_view text, const std::filesystem::path& file) {
  SettingsReading reading;
  SettingsFaults faults(file.string());
  read_toml(text, file, faults, [&](const toml::table& toml) {
    read_all(toml, file.parent_path(), reading.settings, faults);
  });
  reading.faults = faults.in_order();
  return reading;
}

Result<Settings> load_uncalibrated_settings(const std::filesystem::path& file) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(file, missing)) {
    return fail(ErrorCode::kNotFound, "there is no settings file " + file.string(),
                "name one with --config");
  }
  const auto text = read_settings_text(file, "settings file");
  if (!text) return tl::make_unexpected(text.error());
  const auto absolute = std::filesystem::absolute(file, missing);
  SettingsReading reading = read_settings(*text, missing ? file : absolute);
  if (reading.good()) return std::move(reading.settings);
  std::string all;
  for (const auto& fault : reading.faults) all += (all.empty() ? "" : "\n") + fault;
  return fail(ErrorCode::kInvalidInput, all, "");
}

Result<Settings> load_settings(const std::filesystem::path& file) {
  auto settings = load_uncalibrated_settings(file);
  if (!settings) return settings;
  return with_calibration_beside(file, std::move(*settings));
}

}  // namespace instep
