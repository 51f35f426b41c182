#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.h"
#include "drivers/depth_camera.h"
#include "drivers/recording/recording.h"

namespace instep {

/// When a recording is long enough: whichever comes first. At least one must be given.
struct RecordingLength {
  std::optional<std::size_t> frames_per_camera;
  std::optional<std::chrono::milliseconds> time;  ///< of the cameras' own clocks
};

/// Told after each round of the cameras how much of the length is done, from 0 to 1. False: it is
/// no longer wanted.
using RecordingProgress = std::function<bool(double done)>;

/// Takes good frames from all cameras in turn and writes them as a recording, whole or not at all.
/// `header` gives platform, truth and notes; its cameras are those given. Each camera's times are
/// counted from its first frame, since cameras share no clock. Frames that are not good are left
/// out. Fails with kCancelled if it is no longer wanted, with what a camera says (a camera that
/// gives nothing for 2 s fails with kTimeout) or what RecordingWriter says; the cameras are stopped
/// in any case.
Result<Recording> capture_recording(const std::vector<std::unique_ptr<DepthCamera>>& cameras,
                                    Recording header, const RecordingLength& length,
                                    const std::filesystem::path& folder,
                                    const RecordingProgress& progress);

}  // namespace instep
