#include "drivers/v4l2/video_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>

#include "drivers/v4l2/video_call.h"
#include "drivers/v4l2/video_error.h"

namespace instep {
namespace {

constexpr std::uint32_t kType = V4L2_BUF_TYPE_VIDEO_CAPTURE;
/// At 30 frames a second a reader may be late by 0.1 s without a loss.
constexpr std::uint32_t kBuffersWanted = 4;
constexpr std::uint32_t kFewestBuffers = 2;

FrameOrder::Time monotonic_now() {
  return std::chrono::duration_cast<FrameOrder::Time>(
      std::chrono::steady_clock::now().time_since_epoch());
}

std::optional<FrameOrder::Time> stamp_of(const v4l2_buffer& buffer) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return std::nullopt;
  }
  return std::chrono::seconds(buffer.timestamp.tv_sec) + FrameOrder::Time(buffer.timestamp.tv_usec);
}

v4l2_buffer empty_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = kType;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

}  // namespace

Result<std::unique_ptr<VideoStream>> VideoStream::open(VideoSystem& system,
                                                       const std::filesystem::path& node,
                                                       DepthFormat format) {
  const int descriptor = system.open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    return tl::make_unexpected(video_error(errno, "opening " + node.string()));
  }
  std::unique_ptr<VideoStream> stream(new VideoStream(system, descriptor, format));
  if (const auto able = stream->check_abilities(); !able) {
    return tl::make_unexpected(able.error());
  }
  return stream;
}

Result<void> VideoStream::begin(int width, int height, const std::vector<CameraControl>& controls) {
  return agree_on_format(width, height)
      .and_then([&] { return set_controls(system_, descriptor_, controls); })
      .and_then([&] { return share_buffers(); })
      .and_then([&] { return switch_on(); });
}

VideoStream::~VideoStream() {
  // A device that has left refuses some of these; the memory and the descriptor go back all the
  // same.
  std::uint32_t type = kType;
  if (on_) video_call(system_, descriptor_, VIDIOC_STREAMOFF, &type);
  for (const auto& buffer : buffers_) system_.unmap(buffer.data(), buffer.size());
  if (asked_for_buffers_) {
    v4l2_requestbuffers none{};
    none.type = kType;
    none.memory = V4L2_MEMORY_MMAP;
    video_call(system_, descriptor_, VIDIOC_REQBUFS, &none);
  }
  system_.close(descriptor_);
}

Result<void> VideoStream::call(unsigned long request, void* argument, const char* doing) {
  if (video_call(system_, descriptor_, request, argument) == 0) return {};
  return tl::make_unexpected(video_error(errno, doing));
}

Result<void> VideoStream::check_abilities() {
  v4l2_capability abilities{};
  if (auto asked = call(VIDIOC_QUERYCAP, &abilities, "asking what it can do"); !asked) {
    return asked;
  }
  const bool of_node = (abilities.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const std::uint32_t can = of_node ? abilities.device_caps : abilities.capabilities;
  constexpr std::uint32_t kNeeded = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  if ((can & kNeeded) != kNeeded) {
    return fail(ErrorCode::kUnsupported, "it does not stream images", "choose another camera");
  }
  std::string offered;
  for (std::uint32_t i = 0; i < kMostListed; ++i) {
    v4l2_fmtdesc description{};
    description.index = i;
    description.type = kType;
    if (video_call(system_, descriptor_, VIDIOC_ENUM_FMT, &description) != 0) {
      if (errno == EINVAL) break;  // the end of the list
      return tl::make_unexpected(video_error(errno, "listing its formats"));
    }
    if (description.pixelformat == four_letters(format_)) return {};
    offered += (offered.empty() ? "" : ", ") + to_string_of_four(description.pixelformat);
  }
  return fail(ErrorCode::kUnsupported,
              fmt::format("it has no format {}, only: {}", to_string_of_four(four_letters(format_)),
                          offered.empty() ? "none" : offered),
              "set format to one that carries depth");
}

Result<void> VideoStream::agree_on_format(int width, int height) {
  v4l2_format format{};
  format.type = kType;
  format.fmt.pix.width = static_cast<std::uint32_t>(width);
  format.fmt.pix.height = static_cast<std::uint32_t>(height);
  format.fmt.pix.pixelformat = four_letters(format_);
  format.fmt.pix.field = V4L2_FIELD_NONE;
  if (auto set = call(VIDIOC_S_FMT, &format, "setting its format"); !set) return set;
  const auto& agreed = format.fmt.pix;
  auto layout = depth_layout(
      format_, width, height,
      {agreed.pixelformat, agreed.width, agreed.height, agreed.bytesperline, agreed.sizeimage});
  if (!layout) return tl::make_unexpected(layout.error());
  layout_ = *layout;
  return {};
}

Result<void> VideoStream::share_buffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffersWanted;
  request.type = kType;
  request.memory = V4L2_MEMORY_MMAP;
  if (auto got = call(VIDIOC_REQBUFS, &request, "asking for buffers"); !got) return got;
  asked_for_buffers_ = true;
  if (request.count < kFewestBuffers) {
    return fail(ErrorCode::kIo, Remedy::kRetry, "it has memory for one image only",
                "the machine is short of memory; if it stays so, restart instepd");
  }
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = empty_buffer(i);
    if (auto asked = call(VIDIOC_QUERYBUF, &buffer, "asking for a buffer"); !asked) return asked;
    if (buffer.length < layout_.bytes) {
      return fail(ErrorCode::kUnsupported, "its driver's buffers are too small for an image",
                  "report this camera's driver");
    }
    void* memory = system_.map(buffer.length, descriptor_, static_cast<off_t>(buffer.m.offset));
    if (memory == MAP_FAILED) {
      return tl::make_unexpected(video_error(errno, "sharing a buffer"));
    }
    buffers_.emplace_back(static_cast<std::uint8_t*>(memory), buffer.length);
    if (auto queued = call(VIDIOC_QBUF, &buffer, "lending a buffer"); !queued) return queued;
  }
  return {};
}

Result<void> VideoStream::switch_on() {
  const auto begin = monotonic_now();
  std::uint32_t type = kType;
  if (video_call(system_, descriptor_, VIDIOC_STREAMON, &type) != 0) {
    if (errno == ENOSPC) {
      return fail(ErrorCode::kNoBandwidth, "its USB bus has no room for one more stream",
                  "give the camera a USB controller of its own (lsusb -t shows them), or set a "
                  "smaller size");
    }
    return tl::make_unexpected(video_error(errno, "switching the stream on"));
  }
  on_ = true;
  order_.emplace(begin);
  return {};
}

Result<std::optional<VideoStream::Image>> VideoStream::take() {
  v4l2_buffer buffer = empty_buffer(0);
  if (video_call(system_, descriptor_, VIDIOC_DQBUF, &buffer) != 0) {
    if (errno == EAGAIN) return std::nullopt;
    return tl::make_unexpected(video_error(errno, "taking an image"));
  }
  if (buffer.index >= buffers_.size()) {
    return fail(ErrorCode::kIo, Remedy::kReopen, "its driver gives a buffer that was never lent",
                "report this camera's driver");
  }
  Image image;
  const auto memory = buffers_[buffer.index];
  image.place = order_->place(buffer.sequence, stamp_of(buffer), monotonic_now());
  image.flagged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  image.short_of_data = std::min<std::size_t>(buffer.bytesused, memory.size()) < layout_.bytes;
  if (!image.flagged && !image.short_of_data && !image.place.stale) {
    image.depth = read_depth(layout_, memory.data());
  }
  v4l2_buffer back = empty_buffer(buffer.index);
  if (auto queued = call(VIDIOC_QBUF, &back, "lending a buffer again"); !queued) {
    return tl::make_unexpected(queued.error());
  }
  return image;
}

Error VideoStream::why_broken() {
  v4l2_capability abilities{};
  if (const auto answers = call(VIDIOC_QUERYCAP, &abilities, "asking it"); !answers) {
    return answers.error();
  }
  return {ErrorCode::kIo, Remedy::kReopen, "its stream broke off",
          "unplug it and plug it in again; check its cable"};
}

}  // namespace instep
