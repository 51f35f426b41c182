#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "core/result.h"
#include "drivers/openni2/child_messages.h"
#include "drivers/openni2/frame_ring.h"
#include "drivers/openni2/mode_choice.h"

namespace instep {

/// Loads OpenNI2 and its drivers, once in a process and for its life: to unload them again can
/// deadlock. Fails with kUnsupported if there is no driver.
Result<void> load_openni();

/// The sensors on the bus, with what is known of them unopened: not serial number nor modes.
std::vector<OpenniDevice> plugged_in_sensors();

/// One opened sensor and its depth stream. Any call but wait_for_frame() may take as long as the
/// driver wishes, for ever included.
class DepthSensor {
 public:
  /// Fails with kDeviceGone, kPermissionDenied, or kBusy for what may be that.
  static Result<std::unique_ptr<DepthSensor>> open(const OpenniDevice& place);
  ~DepthSensor();

  const OpenniDevice& device() const;  ///< serial number and modes included

  /// Chooses the mode, turns off what bends the image, and reads it all back. Fails with
  /// kUnsupported if the sensor has it another way.
  Result<CameraOpened> set_up(const std::optional<ImageSize>& size);

  Result<void> start();
  void stop();

  /// Waits up to `limit` for a frame and puts it into the ring; false if none came. Fails with
  /// kDeviceGone, or with kIo if the sensor says that its projector fails or that it is too hot.
  Result<bool> wait_for_frame(std::chrono::milliseconds limit, FrameRing& ring);
  /// The same failures, without a frame.
  Result<void> look() const;

 private:
  struct Parts;
  explicit DepthSensor(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace instep
