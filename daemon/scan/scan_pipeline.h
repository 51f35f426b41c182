#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/foot/measuring_rules.h"
#include "core/foot/shoe_sizes.h"
#include "core/foot/side.h"
#include "core/fusion/frames/depth_frame.h"
#include "daemon/scan/scan_record.h"
#include "drivers/depth_camera.h"

namespace instep {

/// Everything that one press of the pedal brought in.
struct Capture {
  std::vector<CameraDescription> cameras;
  std::vector<DepthFrame> frames;     ///< of all cameras, in any order
  std::uint64_t frames_rejected = 0;  ///< that came meanwhile and are not among them, being faulty
  std::optional<double> platform_height_mm;
  bool simulated = false;
  std::string calibration;
  /// What a simulation knows to be true: measure id -> value, with "left_" or "right_" before it
  /// where two feet stand there. Empty for a real capture.
  std::map<std::string, double> truth;
};

/// Told of each stage, and again of the same one with each piece of it that is done; returning
/// false cancels the scan (the pipeline then fails with kCancelled). `done` runs from 0 to 1 over
/// the whole scan and never decreases. Called from one thread at a time, but not always from the
/// same.
using ScanProgress = std::function<bool(std::string_view stage, double done)>;

struct PipelineSettings {
  std::string station = "unnamed";
  double point_spacing_mm = 1.0;
  bool refine_views = true;  ///< fit the views to each other; else poses and lenses are trusted
  std::optional<Side> side;  ///< forced side; nothing = told from the shape
  MeasuringRules measures;
  SizeRules sizes;
  /// Ids are of this time at the earliest, so that they sort behind those that are there; nothing =
  /// of the time at which it is measured.
  std::optional<std::chrono::system_clock::time_point> ids_from;
};

/// The way of a scan, one step a line: deproject -> fuse -> align -> landmarks -> girths. Takes no
/// file and no device; what it measures depends on its arguments alone. The records get ids of
/// their own, and the time at which they were measured. What concerns one camera alone runs on a
/// thread of its own. Gives one record for each foot on the platform, the left one first, and fails
/// if there is none. A left and a right foot are put side by side, in the records of both.
Result<std::vector<ScanRecord>> measure_capture(const Capture& capture,
                                                const PipelineSettings& settings,
                                                const ScanProgress& progress);

}  // namespace instep
