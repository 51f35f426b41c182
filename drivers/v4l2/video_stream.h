#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/v4l2/camera_controls.h"
#include "drivers/v4l2/depth_format.h"
#include "drivers/v4l2/frame_order.h"
#include "drivers/v4l2/video_system.h"

namespace instep {

/// A video node that streams into memory shared with the kernel. Everything taken from the kernel
/// (memory, buffers, descriptor) goes back in the destructor, whatever state the device is in:
/// only then can the node be opened again. Nothing here waits.
class VideoStream {
 public:
  /// Opens a node without changing anything: it may be that of another stream, in use. Fails with
  /// kUnsupported if it does not stream that format (a camera has a node for each of its streams),
  /// and as video_error.h says.
  static Result<std::unique_ptr<VideoStream>> open(VideoSystem& system,
                                                   const std::filesystem::path& node,
                                                   DepthFormat format);
  ~VideoStream();
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;

  /// Agrees on the size, sets the controls and switches the stream on; once. Fails with
  /// kUnsupported if the driver does not agree, kInvalidInput if a control cannot be set,
  /// kNoBandwidth if the USB bus is full, and as video_error.h says.
  Result<void> begin(int width, int height, const std::vector<CameraControl>& controls);

  /// To be polled: readable when take() has something.
  int descriptor() const { return descriptor_; }

  struct Image {
    FrameOrder::Place place;
    bool flagged = false;              ///< the driver says that it is damaged
    bool short_of_data = false;        ///< it ends before its last row
    std::vector<std::uint16_t> depth;  ///< empty if it is damaged, short or stale
  };
  /// The oldest image that waits, copied, and its buffer given back to the kernel; nothing if none
  /// waits.
  Result<std::optional<Image>> take();

  /// What is wrong with a stream whose poll() reports an error: kDeviceGone if the device left.
  Error why_broken();

 private:
  VideoStream(VideoSystem& system, int descriptor, DepthFormat format)
      : system_(system), descriptor_(descriptor), format_(format) {}

  Result<void> check_abilities();
  Result<void> agree_on_format(int width, int height);
  Result<void> share_buffers();
  Result<void> switch_on();
  Result<void> call(unsigned long request, void* argument, const char* doing);

  VideoSystem& system_;
  int descriptor_;
  DepthFormat format_;
  DepthLayout layout_;
  std::vector<std::span<std::uint8_t>> buffers_;
  bool asked_for_buffers_ = false;
  bool on_ = false;
  std::optional<FrameOrder> order_;
};

}  // namespace instep
