#include "drivers/v4l2/v4l2_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

#include "core/fusion/frames/camera_limits.h"
#include "drivers/v4l2/video_error.h"

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

Result<void> check(const V4l2Camera::Settings& settings) {
  const std::string& name = settings.geometry.id;
  if (!is_depth_unit(settings.depth_unit_mm)) {
    return fail(ErrorCode::kInvalidInput,
                fmt::format("camera {} has no depth unit of {} to {} mm", name,
                            kSmallestDepthUnitMm, kLargestDepthUnitMm),
                "set depth_unit_mm: 1.0 for most RealSense, 0.1 for the D405, 0.125 for the SR300");
  }
  if (settings.address == UsbAddress{}) {
    return fail(ErrorCode::kInvalidInput, "camera " + name + " has neither serial nor bus path",
                "set serial or bus_path in the settings");
  }
  return check_intrinsics(settings.geometry.intrinsics);
}

/// Of a socket, the number of what is plugged into it now.
std::string serial_of(const V4l2Camera::Settings& settings) {
  if (!settings.address.serial.empty()) return settings.address.serial;
  const auto nodes = find_video_nodes(settings.address, settings.folders);
  return nodes ? nodes->front().device.address.serial : std::string();
}

}  // namespace

Result<std::unique_ptr<V4l2Camera>> V4l2Camera::create(Settings settings, VideoSystem& system) {
  if (const auto sound = check(settings); !sound) return tl::make_unexpected(sound.error());
  std::unique_ptr<V4l2Camera> camera(new V4l2Camera(std::move(settings), system));
  if (!camera->interrupt_.is_open()) {
    return fail(ErrorCode::kIo, "there is no descriptor left for the camera",
                "raise the limit of open files");
  }
  return camera;
}

V4l2Camera::V4l2Camera(Settings settings, VideoSystem& system)
    : settings_(std::move(settings)), system_(system) {
  description_.geometry = settings_.geometry;
  description_.model = "V4L2 depth camera";
  description_.serial = serial_of(settings_);
  description_.depth_unit_mm = settings_.depth_unit_mm;
}

Result<void> V4l2Camera::start() {
  interrupt_.clear();
  if (stream_) return {};
  const auto nodes = find_video_nodes(settings_.address, settings_.folders);
  if (!nodes) return tl::make_unexpected(nodes.error());
  const auto serial = nodes->front().device.address.serial;
  if (!description_.serial.empty() && serial != description_.serial) {
    return fail(ErrorCode::kUnsupported, "another camera than before is in its place",
                "plug the old one in again, or restart instepd");
  }
  std::optional<Error> refusal;
  for (const auto& node : *nodes) {
    auto stream = VideoStream::open(system_, node.path, settings_.format);
    if (stream) {
      return begin(std::move(*stream)).map([&] { description_.serial = serial; });
    }
    if (stream.error().code != ErrorCode::kUnsupported) {
      return tl::make_unexpected(stream.error());
    }
    if (!refusal) refusal = stream.error();
  }
  return tl::make_unexpected(*refusal);
}

Result<void> V4l2Camera::begin(std::unique_ptr<VideoStream> stream) {
  const auto& lens = settings_.geometry.intrinsics;
  const auto begun = stream->begin(lens.width, lens.height, settings_.controls);
  if (begun) stream_ = std::move(stream);
  return begun;
}

Result<DepthFrame> V4l2Camera::next_frame(milliseconds limit) {
  if (!stream_) return fail(ErrorCode::kInvalidInput, "it is not started", "start it first");
  const auto deadline = steady_clock::now() + limit;
  do {
    auto image = wait_until(deadline).and_then([&] { return stream_->take(); });
    if (!image) {
      if (image.error().code == ErrorCode::kDeviceGone) stop();
      return tl::make_unexpected(image.error());
    }
    if (*image) return frame_of(std::move(**image));
  } while (steady_clock::now() < deadline);
  return fail(ErrorCode::kTimeout, fmt::format("it gave no frame within {} ms", limit.count()),
              "check its cable; if that does not help, unplug it and plug it in again");
}

Result<void> V4l2Camera::wait_until(steady_clock::time_point deadline) {
  std::array<pollfd, 2> waiting{pollfd{interrupt_.descriptor(), POLLIN, 0},
                                pollfd{stream_->descriptor(), POLLIN, 0}};
  const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now()).count();
  constexpr milliseconds::rep kLongestWait = 60000;
  const auto wait = std::clamp<milliseconds::rep>(left, 0, kLongestWait);
  const int ready = system_.poll(waiting.data(), waiting.size(), static_cast<int>(wait));
  if (ready < 0) {
    if (errno == EINTR) return {};
    return tl::make_unexpected(video_error(errno, "waiting for a frame"));
  }
  if (waiting[0].revents != 0) {
    return fail(ErrorCode::kCancelled, "waiting for a frame was stopped", "start again");
  }
  // Images that came before the device left are still good.
  const short device = waiting[1].revents;
  if (device != 0 && (device & POLLIN) == 0) return tl::make_unexpected(stream_->why_broken());
  return {};
}

DepthFrame V4l2Camera::frame_of(VideoStream::Image image) const {
  DepthFrame frame;
  frame.camera = settings_.geometry.id;
  frame.sequence = image.place.sequence;
  frame.width = settings_.geometry.intrinsics.width;
  frame.height = settings_.geometry.intrinsics.height;
  frame.depth_unit_mm = settings_.depth_unit_mm;
  frame.raw = std::move(image.depth);
  frame.device_time = image.place.time;
  frame.host_time = steady_clock::time_point(image.place.time);
  if (image.flagged) {
    frame.status = FrameStatus::kCorrupt;
  } else if (image.short_of_data) {
    frame.status = FrameStatus::kIncomplete;
  } else if (image.place.stale) {
    frame.status = FrameStatus::kStale;
  }
  return frame;
}

void V4l2Camera::stop() {
  stream_.reset();
}

void V4l2Camera::interrupt() {
  interrupt_.set();
}

}  // namespace instep
