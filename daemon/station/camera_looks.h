#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/station/back_off.h"
#include "daemon/station/camera_set.h"

namespace instep {

/// Looks again and again whether the cameras answer: settings.check_every after all did, and soon
/// where one did not. Not during a scan, which tells by itself what its cameras give. Lives on the
/// loop's thread; no call waits.
class CameraLooks {
 public:
  /// `on_end`: a look is over, and trouble() tells what it found.
  CameraLooks(EventLoop& loop, std::shared_ptr<CameraSet> cameras, CaptureSettings settings,
              CameraSet::ZeroFrames zero_frames, std::function<void()> on_end);

  /// Now, unless a look is under way, or when the scan is over; and where that finds a trouble,
  /// again as soon as after the first one.
  void look();
  /// From the next look on.
  void set(const CaptureSettings& settings) { settings_ = settings; }

  /// A scan begins. A look that is under way is given up: what a camera still answers comes from
  /// before the scan, or from being in its way.
  void pause();
  /// It has ended. Looks at once if that is wanted, or a look was given up or asked for meanwhile.
  void resume(bool at_once);

  /// What was wrong with the camera in the last look that was not given up.
  const std::optional<Error>& trouble(std::size_t camera) const { return troubles_[camera]; }
  bool all_answer() const;

 private:
  void begin();
  bool is_under_way() const;
  void answered(std::uint64_t round, std::size_t camera, const Result<void>& outcome);
  /// No answer counts any more.
  void close();
  void end();

  EventLoop& loop_;
  std::shared_ptr<CameraSet> cameras_;
  CaptureSettings settings_;
  CameraSet::ZeroFrames zero_frames_;
  std::function<void()> on_end_;
  std::vector<std::optional<Error>> troubles_;
  std::vector<bool> unanswered_;             ///< of the look that is under way
  std::vector<std::optional<Error>> found_;  ///< by those of it that answered
  std::uint64_t round_ = 0;
  bool is_paused_ = false;
  bool is_wanted_ = false;  ///< after the pause
  EventLoop::Timer next_;
  EventLoop::Timer deadline_;
  BackOff back_off_;
};

}  // namespace instep
