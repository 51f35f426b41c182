#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "drivers/depth_camera.h"
#include "sim/depth_renderer.h"
#include "sim/fault_script.h"
#include "sim/sensor_noise.h"

namespace instep {

enum class Pacing {
  kRealTime,  ///< 30 frames a second of the steady clock
  /// The camera lives in a time of its own: a wait of next_frame() passes at once, whether it ends
  /// with a frame or at its limit, and a start() that fails takes a tenth of a second of that time.
  /// Faults run in it too, so that a stall of 2 s is over after two calls with a limit of 1 s.
  kAsFastAsPossible,
};

/// A camera that looks at a still scene through a noisy sensor, and fails as its script says.
///
/// A restart ends neither a stall nor an absence. Frame k (DepthFrame::sequence k - 1, counted over
/// the camera's life) holds the same bytes whenever and however often it is made. While nobody
/// asks, up to four frames wait; older ones are dropped. DepthFrame::device_time is the camera's
/// own time, 0 at its making. A frame costs about 10 ms at 640x480, spent in next_frame().
class SimulatedCamera final : public DepthCamera {
 public:
  struct Settings {
    CameraGeometry geometry;
    std::string serial;
    NoiseSettings noise;
    Pacing pacing = Pacing::kRealTime;
    std::uint64_t seed = 1;
    CameraFaults faults;
  };

  /// `view` is what the camera sees without noise, of the size of its lens.
  SimulatedCamera(Settings settings, std::shared_ptr<const ExactView> view);

  const CameraDescription& description() const override { return description_; }
  Result<void> start() override;
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override;
  void stop() override;
  void interrupt() override;

 private:
  using Time = std::chrono::microseconds;

  Time now() const;
  void wait_until(std::unique_lock<std::mutex>& lock, Time time);
  void schedule(Time earliest);
  void drop_old_frames();
  bool is_gone();
  DepthFrame make_frame(std::uint64_t number, Time time) const;

  Settings settings_;
  std::shared_ptr<const ExactView> view_;
  CameraDescription description_;
  std::chrono::steady_clock::time_point birth_;

  std::mutex mutex_;
  std::condition_variable interrupted_;
  bool cancelled_ = false;

  bool started_ = false;
  Time own_time_{0};          ///< of Pacing::kAsFastAsPossible
  std::uint64_t frames_ = 0;  ///< that came so far, dropped ones included
  std::optional<Time> due_;   ///< of the next frame; nothing = it never comes
  std::optional<Interruption> absence_;
  Time absent_since_{0};
};

}  // namespace instep
