#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/depth_camera.h"
#include "drivers/files/wake_up.h"
#include "drivers/usb/usb_device.h"
#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/depth_format.h"
#include "drivers/v4l2/video_nodes.h"
#include "drivers/v4l2/video_stream.h"
#include "drivers/v4l2/video_system.h"

namespace instep {

/// A depth camera that the kernel's uvcvideo serves, such as the RealSense D4xx and SR300.
///
/// start() looks for the device anew, opens it and sets everything; stop(), and a device that
/// leaves, give everything back. So unplugging costs no more than the next start(), under whatever
/// /dev/videoN the camera returns. Frames keep the sequence numbers of the driver, from which lost
/// ones can be told. Damaged frames have no pixels.
///
/// DepthFrame::device_time and host_time are the same here: when the driver received the frame, on
/// the clock of this machine, where it says so; otherwise when it was taken from the driver.
///
/// A camera that does not answer its control requests holds start() and stop() up for as long as
/// the kernel waits for them, up to 5 s each; no program can shorten that.
class V4l2Camera final : public DepthCamera {
 public:
  struct Settings {
    CameraGeometry geometry;  ///< its intrinsics have the size of the images
    /// What a raw depth of 1 is worth, above 0 to 100: the camera does not say it.
    double depth_unit_mm = 0.0;
    DepthFormat format = DepthFormat::kZ16;
    UsbAddress address;
    std::vector<CameraControl> controls;  ///< set anew at each start
    DeviceFolders folders;
  };

  /// Does not touch the device, which may come later; one that is told by its socket alone has no
  /// serial number until its first start() then. What is told of a camera holds for its life:
  /// start() takes no other unit that comes into the socket, and fails with kUnsupported. Fails
  /// with kInvalidInput if the depth unit, the intrinsics or the address is absent or cannot be
  /// right, kIo if the process has no descriptor left.
  static Result<std::unique_ptr<V4l2Camera>> create(Settings settings,
                                                    VideoSystem& system = linux_video_system());

  const CameraDescription& description() const override { return description_; }
  Result<void> start() override;
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override;
  void stop() override;
  void interrupt() override;

 private:
  V4l2Camera(Settings settings, VideoSystem& system);

  Result<void> begin(std::unique_ptr<VideoStream> stream);
  /// Until an image may wait, the deadline at the latest. Fails with kCancelled, or with what is
  /// wrong with the device.
  Result<void> wait_until(std::chrono::steady_clock::time_point deadline);
  DepthFrame frame_of(VideoStream::Image image) const;

  const Settings settings_;
  VideoSystem& system_;
  CameraDescription description_;
  WakeUp interrupt_;  ///< set from interrupt() until start()
  std::unique_ptr<VideoStream> stream_;
};

}  // namespace instep
