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

/// Whether one camera's light disturbs another's image: CaptureSettings::one_at_a_time.
enum class CameraTurns { kTogether, kOneAtATime };

/// Told again and again how much of the recording is done, from 0 to 1. False: it is no longer
/// wanted.
using RecordingProgress = std::function<bool(double done)>;

/// The kCancelled of a recording that is no longer wanted.
Error recording_stopped();

/// Takes good frames from all cameras and writes them as a recording, whole or not at all. Together
/// they stream at once and end with the first that has enough; one at a time each streams alone for
/// the whole length. `header` gives platform, truth and notes; its cameras are those given. Each
/// camera's times are counted from its first frame, since cameras share no clock. Frames that
/// FrameTally finds a fault with are left out, as in a scan. Fails with kCancelled if it is no
/// longer wanted, with what a camera says (a camera that gives nothing for 2 s fails with
/// kTimeout), with kCorruptData if one gives faulty frames only, or with what RecordingWriter says;
/// the cameras are stopped in any case.
Result<Recording> capture_recording(const std::vector<std::unique_ptr<DepthCamera>>& cameras,
                                    Recording header, const RecordingLength& length,
                                    CameraTurns turns, const std::filesystem::path& folder,
                                    const RecordingProgress& progress);

}  // namespace instep
