#pragma once

#include <string>

#include "core/result.h"

namespace instep {

/// What is tried for one camera that fails, from gentle to rough, each a few times and then no
/// more: open it again, reset it on its bus, call a person. One that may not be opened is opened
/// again as often, while udev may still be setting the rights of what has just been plugged in.
/// (The retry of a frame comes before all that, in CameraSet::capture.) Every look at the camera
/// opens it again, so that one that recovers by itself serves from then on, on whatever rung. A
/// camera that is still at opening or starting, within its limit (kTimeout and Remedy::kRetry, see
/// DepthCamera::start), is waited for on the rung where it is.
class RecoveryLadder {
 public:
  static constexpr int kReopens = 3;
  static constexpr int kResets = 2;

  /// Of a camera that cannot be reset, the rung of the reset is left out.
  explicit RecoveryLadder(bool can_reset = false) : can_reset_(can_reset) {}

  enum class Step { kReopen, kReset, kOperator };
  /// It failed again: what to do now.
  Step failed(const Error& error);
  /// It answers, or was plugged in anew: the next failure begins at the foot.
  void recovered();

  /// For the status, such as "opened again, 2 of 3"; empty while nothing is wrong.
  std::string text() const;

 private:
  bool can_reset_;
  bool away_ = false;
  bool hopeless_ = false;
  int reopens_ = 0;
  int resets_ = 0;
};

}  // namespace instep
