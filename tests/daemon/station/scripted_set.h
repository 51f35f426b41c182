#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "daemon/station/camera_set.h"
#include "tests/support/scripted_camera.h"

namespace instep::test {

/// Two cameras, "left" and "right", that do as they are told.
inline std::unique_ptr<CameraSet> cameras(std::deque<ScriptedCamera::Step> left,
                                          std::deque<ScriptedCamera::Step> right) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::make_unique<ScriptedCamera>("left", std::move(left)));
  all.push_back(std::make_unique<ScriptedCamera>("right", std::move(right)));
  return std::make_unique<CameraSet>(std::move(all));
}

inline CaptureSettings settings() {
  CaptureSettings settings;
  settings.frames_per_camera = 5;
  settings.warmup_frames = 2;
  settings.frame_limit = std::chrono::milliseconds(50);
  settings.deadline = std::chrono::seconds(60);
  return settings;
}

/// For captures that their deadline is to end.
inline CaptureSettings soon_over() {
  CaptureSettings soon = settings();
  soon.deadline = std::chrono::milliseconds(400);
  return soon;
}

/// For captures that end before any limit, or never.
inline CaptureSettings without_end() {
  CaptureSettings patient = settings();
  patient.frame_limit = std::chrono::hours(1);
  patient.deadline = std::chrono::hours(1);
  return patient;
}

inline bool go_on() {
  return true;
}

}  // namespace instep::test
