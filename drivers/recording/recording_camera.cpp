#include "drivers/recording/recording_camera.h"

#include <fmt/core.h>

#include <algorithm>

#include "drivers/recording/recording_reader.h"

namespace instep {
namespace {

using std::chrono::microseconds;
using std::chrono::steady_clock;

/// How long a round of a loop lasts: to the last frame and one mean interval more.
microseconds loop_period(const Recording& recording, std::size_t frames_of_camera) {
  const auto [first, last] = std::minmax_element(
      recording.frames.begin(), recording.frames.end(),
      [](const RecordedFrame& a, const RecordedFrame& b) { return a.time < b.time; });
  const microseconds length = last->time - first->time;
  constexpr microseconds kUsualInterval{33333};
  if (frames_of_camera < 2 || length.count() == 0) return length + kUsualInterval;
  return length + length / static_cast<microseconds::rep>(frames_of_camera - 1);
}

}  // namespace

Result<std::unique_ptr<RecordingCamera>> RecordingCamera::open(
    std::shared_ptr<const Recording> recording, const std::string& camera,
    RecordingCameraSettings settings) {
  const CameraDescription* description = recording->find_camera(camera);
  if (description == nullptr) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("the recording {} has no camera \"{}\"", recording->folder.string(), camera),
        "choose one of its cameras");
  }
  return std::unique_ptr<RecordingCamera>(
      new RecordingCamera(std::move(recording), *description, settings));
}

RecordingCamera::RecordingCamera(std::shared_ptr<const Recording> recording,
                                 CameraDescription description, RecordingCameraSettings settings)
    : recording_(std::move(recording)), description_(std::move(description)), settings_(settings) {
  const auto& frames = recording_->frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].camera == description_.geometry.id) frames_.push_back(i);
    if (i == 0 || frames[i].time < first_time_) first_time_ = frames[i].time;
  }
  if (!frames_.empty()) period_ = loop_period(*recording_, frames_.size());
}

Result<void> RecordingCamera::start() {
  {
    const std::lock_guard lock(mutex_);
    interrupted_ = false;
  }
  if (started_) return {};
  started_ = true;
  sequence_ = 0;
  started_at_ = steady_clock::now();
  return {};
}

Result<DepthFrame> RecordingCamera::next_frame(std::chrono::milliseconds limit) {
  if (!started_) {
    return fail(ErrorCode::kInvalidInput, "the camera is not started", "start it first");
  }
  const auto deadline = steady_clock::now() + limit;
  const bool over = frames_.empty() || (!settings_.loop && sequence_ >= frames_.size());
  auto due = deadline;
  if (!over) {
    const auto round = static_cast<microseconds::rep>(sequence_ / frames_.size());
    const auto& frame = recording_->frames[frames_[sequence_ % frames_.size()]];
    due = settings_.as_recorded ? started_at_ + (frame.time - first_time_) + round * period_
                                : steady_clock::time_point{};
  }
  {
    std::unique_lock lock(mutex_);
    woken_.wait_until(lock, std::min(due, deadline), [this] { return interrupted_; });
    if (interrupted_) {
      return fail(ErrorCode::kCancelled, "waiting for a frame was stopped", "start again");
    }
  }
  if (over || due > deadline) {
    return fail(ErrorCode::kTimeout,
                fmt::format("camera {} gave no frame within {} ms", description_.geometry.id,
                            limit.count()),
                over ? "the recording is over" : "wait longer");
  }
  return read_next();
}

Result<DepthFrame> RecordingCamera::read_next() {
  const std::size_t place = sequence_ % frames_.size();
  const auto round = static_cast<microseconds::rep>(sequence_ / frames_.size());
  const auto& recorded = recording_->frames[frames_[place]];
  auto frame = read_recorded_frame(*recording_, frames_[place], sequence_);
  if (!frame && frame.error().code == ErrorCode::kCorruptData) {
    frame = DepthFrame{};
    frame->camera = recorded.camera;
    frame->sequence = sequence_;
    frame->width = description_.geometry.intrinsics.width;
    frame->height = description_.geometry.intrinsics.height;
    frame->depth_unit_mm = description_.depth_unit_mm;
    frame->status = FrameStatus::kCorrupt;
  } else if (!frame) {
    return fail(ErrorCode::kDeviceGone, frame.error().message, frame.error().advice);
  }
  ++sequence_;
  frame->device_time = recorded.time + round * period_;
  frame->host_time = steady_clock::now();
  return frame;
}

void RecordingCamera::stop() {
  started_ = false;
}

void RecordingCamera::interrupt() {
  {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
  }
  woken_.notify_all();
}

}  // namespace instep
