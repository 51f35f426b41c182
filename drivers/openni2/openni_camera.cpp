#include "drivers/openni2/openni_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drivers/openni2/simulated_vendor.h"

namespace instep {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Phase = OpenniChild::Phase;

constexpr milliseconds kStartLimit{900};

/// Focal length of an image of so many pixels that covers a field of view edge to edge.
double focal_length_px(int pixels, double field_of_view_rad) {
  return 0.5 * pixels / std::tan(0.5 * field_of_view_rad);
}

CameraIntrinsics nominal_lens(const CameraOpened& opened) {
  CameraIntrinsics lens;
  lens.width = opened.mode.width;
  lens.height = opened.mode.height;
  lens.fx = focal_length_px(lens.width, opened.horizontal_fov_rad);
  lens.fy = focal_length_px(lens.height, opened.vertical_fov_rad);
  lens.cx = 0.5 * (lens.width - 1);
  lens.cy = 0.5 * (lens.height - 1);
  return lens;
}

std::optional<ImageSize> size_of(const std::optional<CameraIntrinsics>& lens) {
  if (!lens) return std::nullopt;
  return ImageSize{lens->width, lens->height};
}

/// True if the child, though not there yet, is worth another call.
bool is_passing(const Error& error) {
  return error.code == ErrorCode::kTimeout || error.code == ErrorCode::kCancelled;
}

}  // namespace

Result<std::unique_ptr<OpenniCamera>> OpenniCamera::open(Settings settings) {
  std::unique_ptr<OpenniCamera> camera(new OpenniCamera(std::move(settings)));
  if (!camera->interrupt_.is_open()) {
    return fail(ErrorCode::kIo, Remedy::kRetry, "there are no descriptors left for a camera",
                "restart instepd");
  }
  // No limit of its own: a child that waits for its turn shows that it lives, and one that does not
  // is said to hang.
  constexpr auto kWhileItLives = steady_clock::time_point::max();
  auto done =
      camera->launch()
          .and_then([&] {
            return camera->child_->wait_for(Phase::kOpen, kWhileItLives, camera->interrupt_);
          })
          .and_then([&] { return camera->describe(camera->child_->opened()); });
  if (!done) return tl::make_unexpected(done.error());
  return camera;
}

Result<void> OpenniCamera::launch() {
  auto launched = OpenniChild::launch(
      settings_.program,
      {settings_.serial, size_of(settings_.intrinsics), settings_.opening_limit});
  if (!launched) return tl::make_unexpected(launched.error());
  child_ = std::move(*launched);
  return {};
}

Result<void> OpenniCamera::describe(const CameraOpened& opened) {
  const bool has_view = opened.horizontal_fov_rad > 0.0 && opened.vertical_fov_rad > 0.0;
  if (!settings_.intrinsics && !has_view) {
    return fail(ErrorCode::kUnsupported, "the sensor does not say its field of view",
                "calibrate it and give its intrinsics");
  }
  description_.geometry.id = settings_.name;
  description_.geometry.intrinsics =
      settings_.intrinsics ? *settings_.intrinsics : nominal_lens(opened);
  description_.geometry.station_from_camera = settings_.station_from_camera;
  description_.model = fmt::format("{} {}", opened.device.vendor, opened.device.product);
  description_.serial = opened.device.serial;
  description_.depth_unit_mm = opened.mode.depth_unit_mm;
  description_.simulated = opened.device.vendor == kSimulatedVendor;
  return check_intrinsics(description_.geometry.intrinsics);
}

/// What was told of a camera holds for its life.
Result<void> OpenniCamera::check_same(const CameraOpened& opened) const {
  const CameraIntrinsics& lens = description_.geometry.intrinsics;
  if (opened.mode.width == lens.width && opened.mode.height == lens.height &&
      opened.mode.depth_unit_mm == description_.depth_unit_mm &&
      opened.device.serial == description_.serial) {
    return {};
  }
  return fail(ErrorCode::kUnsupported, "another sensor than before is in its place",
              "plug the old one in again, or restart instepd");
}

Result<void> OpenniCamera::start() {
  interrupt_.clear();
  if (child_) {
    if (const auto well = child_->look(); !well) drop_child(well.error());
  }
  if (child_ && started_) return {};
  started_ = false;
  if (!child_) {
    if (auto launched = launch(); !launched) return launched;
  }
  if (const auto done = bring_to_stream(); !done) {
    Error error = done.error();
    if (!is_passing(error) || !child_->is_well()) {
      drop_child(error);
    } else if (error.code == ErrorCode::kTimeout && dropped_for_) {
      error.message = dropped_for_->message;
      error.advice = dropped_for_->advice;
    }
    return tl::make_unexpected(error);
  }
  dropped_for_.reset();
  started_ = true;
  numbers_.begin_stream();
  return {};
}

/// It may be opening, starting or stopping still after an earlier call, or stream since one that
/// waited no longer for that.
Result<void> OpenniCamera::bring_to_stream() {
  if (child_->phase() == Phase::kStreaming) {
    child_->drop_frames();
    return {};
  }
  const auto deadline = steady_clock::now() + kStartLimit;
  auto done = Result<void>();
  if (child_->phase() != Phase::kStarting) {
    done = child_->wait_for(Phase::kOpen, deadline, interrupt_)
               .and_then([&] { return check_same(child_->opened()); })
               .map([&] { child_->start(); });
  }
  return done.and_then([&] { return child_->wait_for(Phase::kStreaming, deadline, interrupt_); });
}

void OpenniCamera::drop_child(const Error& cause) {
  started_ = false;
  child_.reset();
  dropped_for_ = cause;
}

Result<DepthFrame> OpenniCamera::next_frame(milliseconds limit) {
  if (!started_) {
    return fail(ErrorCode::kInvalidInput, fmt::format("camera {} was not started", settings_.name),
                "start it first");
  }
  auto frame = child_->next_frame(steady_clock::now() + limit, interrupt_);
  if (frame) return to_frame(std::move(*frame));
  if (!is_passing(frame.error()) || !child_->is_well()) drop_child(frame.error());
  return tl::make_unexpected(frame.error());
}

DepthFrame OpenniCamera::to_frame(RingFrame from) {
  const RingRecord& record = from.record;
  const steady_clock::time_point told{std::chrono::nanoseconds(record.host_time_ns)};
  last_host_time_ =
      std::clamp(told, last_host_time_, std::max(last_host_time_, steady_clock::now()));

  DepthFrame frame;
  frame.camera = settings_.name;
  frame.sequence = numbers_.next(record.sequence);
  frame.width = description_.geometry.intrinsics.width;
  frame.height = description_.geometry.intrinsics.height;
  frame.depth_unit_mm = description_.depth_unit_mm;
  frame.device_time = std::chrono::microseconds(record.device_time_us);
  frame.host_time = last_host_time_;
  frame.status = record.status;
  frame.raw = std::move(from.raw);
  const auto whole = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  const bool said_to_be_bad =
      frame.status == FrameStatus::kCorrupt || frame.status == FrameStatus::kIncomplete;
  if (!said_to_be_bad) {
    frame.status = frame.raw.size() == whole ? FrameStatus::kGood : FrameStatus::kCorrupt;
  }
  return frame;
}

void OpenniCamera::stop() {
  started_ = false;
  if (!child_) return;
  const Phase phase = child_->phase();
  if (phase == Phase::kStreaming || phase == Phase::kStarting) child_->stop();
}

void OpenniCamera::interrupt() {
  interrupt_.set();
}

}  // namespace instep
