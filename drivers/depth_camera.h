#pragma once

#include <chrono>
#include <string>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"

namespace instep {

/// What a camera says of itself; enough to name it in a result and to fuse its frames.
struct CameraDescription {
  CameraGeometry geometry;
  std::string model;
  std::string serial;  ///< empty where the device has none
  double depth_unit_mm = 1.0;
  bool simulated = false;
};

/// A source of depth frames. A backend translates what its device does into these calls and
/// decides nothing: whether to retry, reopen or give up is the daemon's business.
///
/// One thread owns a camera and makes all calls, but interrupt(), which any thread may make. No
/// call blocks longer than its limit, or where it has none than 2 s, unless its backend says so.
class DepthCamera {
 public:
  virtual ~DepthCamera() = default;

  /// A start() may add the serial number, of a device that was away before.
  virtual const CameraDescription& description() const = 0;

  /// Begins streaming. Starting a started camera is a no-op. Fails with kNotFound or kDeviceGone
  /// while the device is away, kBusy while someone else has it, kTimeout and Remedy::kRetry while
  /// it takes longer than a call may: it goes on by itself, to a limit of its own; call again.
  virtual Result<void> start() = 0;

  /// The next frame in the order of the device, bad ones included (see DepthFrame::status). Frames
  /// that came while nobody asked may be dropped, the oldest first; `sequence` shows it. Fails with
  /// kTimeout if none came within `limit`, kDeviceGone if the device left (start() may bring it
  /// back), kCancelled after interrupt(), kInvalidInput if not started.
  virtual Result<DepthFrame> next_frame(std::chrono::milliseconds limit) = 0;

  /// Ends streaming, or a start that goes on by itself, and drops frames that wait. Stopping a
  /// stopped camera is a no-op.
  virtual void stop() = 0;

  /// Makes a waiting next_frame(), and the next one if none waits, return kCancelled at once. Safe
  /// from any thread; cleared by start().
  virtual void interrupt() = 0;
};

}  // namespace instep
