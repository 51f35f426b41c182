#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/depth_camera.h"
#include "drivers/recording/recording.h"

namespace instep {

struct RecordingCameraSettings {
  /// Frames come at the pace of their time stamps, from start() on; otherwise at once.
  bool as_recorded = false;
  /// Starts again at the end, with sequence and device_time running on.
  bool loop = false;
};

/// One camera of a recording as if it were plugged in.
///
/// At the end of the recording it falls silent, as a camera does whose scene is over: next_frame()
/// waits out its limit and fails with kTimeout. An image that is damaged comes as a frame of status
/// kCorrupt, one that cannot be read as kDeviceGone. start() begins at the first frame again. The
/// recordings of several cameras that are started together stay in step.
class RecordingCamera final : public DepthCamera {
 public:
  /// Fails with kNotFound if the recording has no such camera. Shares the recording, so that many
  /// cameras need it once; images are read as they are asked for.
  static Result<std::unique_ptr<RecordingCamera>> open(std::shared_ptr<const Recording> recording,
                                                       const std::string& camera,
                                                       RecordingCameraSettings settings = {});

  const CameraDescription& description() const override { return description_; }
  Result<void> start() override;
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override;
  void stop() override;
  void interrupt() override;

 private:
  RecordingCamera(std::shared_ptr<const Recording> recording, CameraDescription description,
                  RecordingCameraSettings settings);

  Result<DepthFrame> read_next();

  const std::shared_ptr<const Recording> recording_;
  const CameraDescription description_;
  const RecordingCameraSettings settings_;
  std::vector<std::size_t> frames_;          ///< of this camera, as indices into the recording
  std::chrono::microseconds first_time_{0};  ///< of the whole recording
  std::chrono::microseconds period_{0};      ///< from one round of a loop to the next

  bool started_ = false;
  std::uint64_t sequence_ = 0;  ///< of the frame that comes next
  std::chrono::steady_clock::time_point started_at_;

  std::mutex mutex_;
  std::condition_variable woken_;
  bool interrupted_ = false;  ///< guarded by mutex_
};

}  // namespace instep
