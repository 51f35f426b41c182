#pragma once

#include "config/settings.h"

namespace instep::test {

/// One small simulated camera and no pedal: a station that scans at once.
inline Settings small_station() {
  Settings settings;
  settings.cameras.emplace_back();
  settings.pedal.kind = PedalKind::kNone;
  settings.capture.frames_per_camera = 1;
  settings.capture.warmup_frames = 0;
  settings.simulation.cameras = 1;
  settings.simulation.width_px = 64;
  settings.simulation.height_px = 48;
  settings.simulation.pacing = SimulatedPacing::kAsFastAsPossible;
  settings.simulation.truth = false;
  return settings;
}

}  // namespace instep::test
