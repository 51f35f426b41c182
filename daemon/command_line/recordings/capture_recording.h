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
  std::optional<std::chrono::milliseconds> time;  ///< from the first frame of each camera
};

/// Whether one camera's light disturbs another's image: CaptureSettings::one_at_a_time.
enum class CameraTurns { kTogether, kOneAtATime };

/// What DepthFrame::device_time counts on.
enum class CameraClocks {
  /// Each camera has a clock of its own. What puts them on one is DepthFrame::host_time: what a
  /// frame was late by differs from frame to frame, and the least of it is taken for none.
  kOfEachCamera,
  kOneForAll,  ///< as in a simulation that is not paced
};

/// How frames are taken.
struct RecordingPlan {
  RecordingLength length;
  CameraTurns turns = CameraTurns::kTogether;
  CameraClocks clocks = CameraClocks::kOfEachCamera;
  int warmup_frames = 0;  ///< CaptureSettings::warmup_frames
};

/// Told again and again how much of the recording is done, from 0 to 1. False: it is no longer
/// wanted.
using RecordingProgress = std::function<bool(double done)>;

/// The kCancelled of a recording that is no longer wanted.
Error recording_stopped();

/// Takes good frames from all cameras and writes them as a recording, whole or not at all. Together
/// they stream at once and end with the first that has enough; one at a time each streams alone for
/// the whole length. `header` gives platform, truth and notes; its cameras are those given. Times
/// count from the earliest frame. As in a scan, the first `warmup_frames` of each camera are left
/// out whatever they hold, and of the others those that FrameTally finds a fault with. Fails with
/// kCancelled if it is no longer wanted, with what a camera says (a camera that gives nothing for
/// 2 s fails with kTimeout), with kCorruptData if one gives faulty frames only, or with what
/// RecordingWriter says; the cameras are stopped in any case.
Result<Recording> capture_recording(const std::vector<std::unique_ptr<DepthCamera>>& cameras,
                                    Recording header, const RecordingPlan& plan,
                                    const std::filesystem::path& folder,
                                    const RecordingProgress& progress);

}  // namespace instep
