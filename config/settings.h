#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/calibration/applied_calibration.h"
#include "config/devices/openni_settings.h"
#include "config/devices/output_settings.h"
#include "config/devices/pedal_sources.h"
#include "config/devices/v4l2_settings.h"
#include "core/foot/measuring_rules.h"
#include "core/foot/shoe_sizes.h"
#include "core/foot/side.h"

namespace instep {

/// Everything that can be set about a station, with the values it has when nothing is said. A plain
/// value; ranges stand beside each field and are checked by the loader (settings_file.h).

struct StationSettings {
  std::string name = "unnamed";  ///< written into every result; 1 to 64 characters
  /// z of the standing surface in the station frame, -1000 to 1000. Nothing = as the cameras say.
  std::optional<double> platform_height_mm;
  double point_spacing_mm = 1.0;  ///< of the fused cloud, 0.2 to 10
  bool refine_views = true;  ///< fit the views to each other; else poses and lenses are trusted
  std::optional<Side> side;  ///< forced side; nothing = told from the shape
};

struct CaptureSettings {
  int frames_per_camera = 15;                   ///< 1 to 120
  int warmup_frames = 3;                        ///< dropped before the first one counts, 0 to 120
  std::chrono::milliseconds deadline{5000};     ///< for the whole capture, 200 to 60000
  std::chrono::milliseconds frame_limit{1000};  ///< for a single frame, 50 to 5000
  /// The cameras take turns, for those whose projectors disturb each other. What switches an
  /// emitter is its stream: OpenNI2 has a property for it (EmitterState of PS1080), which can be
  /// written but not read, so that nobody could tell whether a sensor obeyed.
  bool one_at_a_time = false;
  std::chrono::seconds check_every{60};  ///< idle cameras are looked at this often, 1 to 3600
};

enum class PedalKind { kNone, kSimulated, kGpio, kEvdev };

struct PedalSettings {
  PedalKind kind = PedalKind::kSimulated;
  std::chrono::milliseconds debounce{30};            ///< 5 to 200
  std::chrono::milliseconds hold_to_cancel{2000};    ///< 500 to 10000
  std::filesystem::path fifo = "/run/instep/pedal";  ///< of the simulated pedal
  GpioPedalSettings gpio;
  EvdevPedalSettings evdev;
};

/// Where depth frames come from. One source may bring several cameras.
enum class CameraKind { kSimulated, kRecording, kOpenni, kV4l2 };

struct CameraSettings {
  CameraKind kind = CameraKind::kSimulated;
  std::filesystem::path path;  ///< of a recording: its folder
  OpenniSettings openni;       ///< of kOpenni
  V4l2Settings v4l2;           ///< of a V4L2 camera

  /// Of a real camera; nullptr where the source brings its own cameras and their poses.
  const CameraPlacement* placement() const;
  CameraPlacement* placement();
};

enum class SimulatedNoise { kNone, kTypical, kPessimistic };
enum class SimulatedSubject { kFoot, kFeet, kCylinder, kLast };
enum class SimulatedPacing { kRealTime, kAsFastAsPossible };

struct SimulatedStationSettings {
  std::uint64_t seed = 1;
  SimulatedSubject subject = SimulatedSubject::kFoot;
  Side side = Side::kRight;
  int cameras = 4;      ///< 1 to 8
  int width_px = 640;   ///< 64 to 1280
  int height_px = 480;  ///< 48 to 960
  SimulatedNoise noise = SimulatedNoise::kTypical;
  SimulatedPacing pacing = SimulatedPacing::kRealTime;
  bool truth = true;  ///< results carry the true measures, worked out beside the first scan
  std::filesystem::path fault_script;  ///< empty = nothing goes wrong
};

struct StoreSettings {
  std::filesystem::path root = "/var/lib/instep/scans";
  int keep_days = 0;   ///< older results are deleted, 0 (never) to 36500
  int keep_count = 0;  ///< beyond this many the oldest are deleted, 0 (no limit) to 1000000
};

/// Most tables of a shop, and most rows of one.
inline constexpr std::size_t kMostShopTables = 32;
inline constexpr std::size_t kMostShopSizes = 64;

struct ControlSettings {
  std::filesystem::path socket = "/run/instep/control.sock";  ///< at most 100 characters
};

enum class LogLevel { kDebug, kInfo, kWarning, kError };

struct LogSettings {
  LogLevel level = LogLevel::kInfo;
};

struct Settings {
  StationSettings station;
  CaptureSettings capture;
  PedalSettings pedal;
  OutputSettings outputs;
  std::vector<CameraSettings> cameras;  ///< 1 to 8
  SimulatedStationSettings simulation;
  StoreSettings store;
  MeasuringRules measures;
  SizeRules sizes;
  ControlSettings control;
  LogSettings log;
  /// Where real cameras' poses come from that are not the file's own.
  std::optional<AppliedCalibration> calibration;

  /// Whether a camera or the pedal is simulated: only these have faults on command.
  bool has_simulated_parts() const;
};

}  // namespace instep
