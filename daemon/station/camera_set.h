#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "config/settings.h"
#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"
#include "daemon/loop/progress_watch.h"
#include "daemon/station/frame_tally.h"
#include "drivers/depth_camera.h"

namespace instep {

/// The cameras of the station, each on a thread of its own, so that one that hangs holds up neither
/// the others nor the daemon. All calls may be made from any thread; none but capture() waits.
class CameraSet {
 public:
  explicit CameraSet(std::vector<std::unique_ptr<DepthCamera>> cameras);
  /// end_by() a moment from now.
  ~CameraSet();
  CameraSet(const CameraSet&) = delete;
  CameraSet& operator=(const CameraSet&) = delete;

  std::size_t size() const { return workers_.size(); }
  /// As they were told at the last start of each.
  std::vector<CameraDescription> descriptions() const;
  /// Of all frames that this camera has given here.
  FrameCounts frame_counts(std::size_t camera) const;
  /// Of all cameras.
  std::uint64_t faulty_frames() const;

  /// The good frames of all cameras, or nothing: a partial set is never returned. Starts the
  /// cameras, drops what warms them up and what is damaged or empty, and stops them again. If a
  /// camera fails and there is time left, the whole set is taken once more; if that fails too, the
  /// error names the cameras. Asks `go_on` at least every 20 ms. Returns by settings.deadline, at
  /// the latest 300 ms later.
  Result<std::vector<DepthFrame>> capture(const CaptureSettings& settings,
                                          const std::function<bool()>& go_on);

  /// What is made of frames without any depth, where no scan asked for them.
  enum class ZeroFrames { kAreFaulty, kAreAsExpected };

  /// Looks whether each camera gives a frame that is no worse than those a scan drops, and reports
  /// each on its thread, twice settings.frame_limit and a call of start() later at the latest. One
  /// that is not done with what it was asked before is looked at when it is, which may be never:
  /// who asks has to set a limit. It then reports to whoever asked last. The remedy of one that
  /// streams and sends nothing is kReopen.
  using Report = std::function<void(std::size_t camera, Result<void> outcome)>;
  void check(const CaptureSettings& settings, ZeroFrames zero_frames, const Report& report);

  /// Interrupts what runs and waits for it. False if a camera had to be left behind; no call but
  /// the destructor may follow.
  bool end_by(std::chrono::steady_clock::time_point deadline);

  /// Enters every camera's thread for the watchdog.
  void note_progress(ProgressWatch& watch) const;

 private:
  struct Worker;
  struct Gathering;
  struct Look;

  Result<std::vector<DepthFrame>> capture_once(const CaptureSettings& settings,
                                               std::chrono::steady_clock::time_point deadline,
                                               const std::function<bool()>& go_on);
  std::shared_ptr<Gathering> ask_all(const CaptureSettings& settings);
  Result<std::vector<DepthFrame>> frames_of(Gathering& gathering) const;
  void interrupt() const;

  std::vector<std::shared_ptr<Worker>> workers_;
};

}  // namespace instep
