#include "config/capture_time.h"

#include <fmt/format.h>

#include <algorithm>

namespace instep {
namespace {

constexpr int kFramesPerSecond = 30;

/// Those that are read one after the other.
int turns(const Settings& settings) {
  if (!settings.capture.one_at_a_time) return 1;
  int cameras = 0;
  for (const auto& camera : settings.cameras) {
    cameras += camera.kind == CameraKind::kSimulated ? settings.simulation.cameras : 1;
  }
  return std::max(cameras, 1);
}

bool loses_no_time(const Settings& settings) {
  return settings.simulation.pacing == SimulatedPacing::kAsFastAsPossible &&
         std::all_of(settings.cameras.begin(), settings.cameras.end(),
                     [](const auto& camera) { return camera.kind == CameraKind::kSimulated; });
}

}  // namespace

std::string warning_of_short_deadline(const Settings& settings) {
  const auto& capture = settings.capture;
  const std::chrono::milliseconds needed(1000LL * turns(settings) *
                                         (capture.warmup_frames + capture.frames_per_camera) /
                                         kFramesPerSecond);
  if (loses_no_time(settings) || needed <= capture.deadline) return {};
  return fmt::format(
      "capture.deadline_ms = {} is too short for a scan: {} frames and {} to warm up take {} ms{} "
      "at "
      "{} frames a second; raise it, or lower capture.frames_per_camera",
      capture.deadline.count(), capture.frames_per_camera, capture.warmup_frames, needed.count(),
      capture.one_at_a_time ? " one camera after the other" : "", kFramesPerSecond);
}

}  // namespace instep
