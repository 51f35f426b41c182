#include "sim/simulated_camera.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/random.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::microseconds kFramePeriod = 33333us;
constexpr int kWaitingFrames = 4;
constexpr std::chrono::microseconds kFailedStart = 100ms;

bool any_holds(const std::vector<FrameRange>& ranges, std::uint64_t frame) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [frame](const FrameRange& range) { return range.holds(frame); });
}

}  // namespace

SimulatedCamera::SimulatedCamera(Settings settings, std::shared_ptr<const ExactView> view)
    : settings_(std::move(settings)),
      view_(std::move(view)),
      birth_(std::chrono::steady_clock::now()) {
  description_.geometry = settings_.geometry;
  description_.model = "simulated depth camera";
  description_.serial = settings_.serial;
  description_.depth_unit_mm = kSimulatedDepthUnitMm;
  description_.simulated = true;
  schedule(Time{0});
}

SimulatedCamera::Time SimulatedCamera::now() const {
  if (settings_.pacing == Pacing::kAsFastAsPossible) return own_time_;
  return std::chrono::duration_cast<Time>(std::chrono::steady_clock::now() - birth_);
}

/// Returns at `time` or when interrupted.
void SimulatedCamera::wait_until(std::unique_lock<std::mutex>& lock, Time time) {
  if (settings_.pacing == Pacing::kAsFastAsPossible) {
    own_time_ = std::max(own_time_, time);
    return;
  }
  interrupted_.wait_until(lock, birth_ + time, [this] { return cancelled_; });
}

/// Sets when the next frame comes, given that none may come before `earliest`.
void SimulatedCamera::schedule(Time earliest) {
  due_ = earliest;
  if (settings_.faults.never_streams) due_.reset();
  for (const Interruption& stall : settings_.faults.stalls) {
    if (stall.after != frames_ || !due_) continue;
    if (stall.duration) {
      *due_ += *stall.duration;
    } else {
      due_.reset();
    }
  }
  for (const Interruption& absence : settings_.faults.absences) {
    if (absence.after != frames_) continue;
    absence_ = absence;
    absent_since_ = now();
  }
}

/// What a camera does while nobody asks: its queue holds the youngest frames.
void SimulatedCamera::drop_old_frames() {
  while (due_ && !absence_ && *due_ + kWaitingFrames * kFramePeriod < now()) {
    ++frames_;
    schedule(*due_ + kFramePeriod);
  }
}

bool SimulatedCamera::is_gone() {
  if (absence_ && absence_->duration && now() >= absent_since_ + *absence_->duration) {
    absence_.reset();
  }
  return absence_.has_value();
}

Result<void> SimulatedCamera::start() {
  const std::lock_guard lock(mutex_);
  cancelled_ = false;
  if (started_ && !absence_) return {};
  if (settings_.faults.never_starts || is_gone()) {
    started_ = false;
    own_time_ += kFailedStart;
    return fail(ErrorCode::kDeviceGone,
                fmt::format("camera {} is not there", description_.geometry.id),
                "plug it in again");
  }
  started_ = true;
  if (due_) due_ = std::max(*due_, now() + kFramePeriod);
  return {};
}

Result<DepthFrame> SimulatedCamera::next_frame(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  const std::string& name = description_.geometry.id;
  if (!started_) {
    return fail(ErrorCode::kInvalidInput, fmt::format("camera {} was not started", name),
                "start it first");
  }
  drop_old_frames();
  const Time deadline = now() + limit;
  if (!cancelled_ && !absence_) wait_until(lock, due_ ? std::min(*due_, deadline) : deadline);
  if (cancelled_) {
    return fail(ErrorCode::kCancelled, fmt::format("waiting for camera {} was stopped", name), "");
  }
  if (absence_) {
    started_ = false;
    return fail(ErrorCode::kDeviceGone, fmt::format("camera {} left", name), "plug it in again");
  }
  if (!due_ || *due_ > now()) {
    return fail(ErrorCode::kTimeout,
                fmt::format("camera {} sent no frame within {} ms", name, limit.count()),
                "check its cable");
  }
  const Time time = *due_;
  const std::uint64_t number = ++frames_;
  schedule(time + kFramePeriod);
  lock.unlock();
  return make_frame(number, time);
}

void SimulatedCamera::stop() {
  const std::lock_guard lock(mutex_);
  started_ = false;
}

void SimulatedCamera::interrupt() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  interrupted_.notify_all();
}

DepthFrame SimulatedCamera::make_frame(std::uint64_t number, Time time) const {
  DepthFrame frame;
  frame.camera = description_.geometry.id;
  frame.sequence = number - 1;
  frame.width = view_->width;
  frame.height = view_->height;
  frame.depth_unit_mm = kSimulatedDepthUnitMm;
  frame.device_time = time;
  frame.host_time = std::chrono::steady_clock::now();
  const std::uint64_t seed = seed_for(settings_.seed, number);
  if (any_holds(settings_.faults.zero, number)) {
    frame.raw.assign(view_->depth_mm.size(), 0);
  } else {
    frame.raw = noisy_frame(*view_, settings_.noise, seed);
  }
  if (any_holds(settings_.faults.corrupt, number)) {
    frame.status = FrameStatus::kCorrupt;
    Random random(seed_for(seed, 1));
    const std::size_t torn_from = random.bits() % frame.raw.size();
    for (std::size_t i = torn_from; i < frame.raw.size(); ++i) {
      frame.raw[i] = static_cast<std::uint16_t>(random.bits() & 0xFFFFU);
    }
  }
  if (any_holds(settings_.faults.shortened, number)) {
    const auto width = static_cast<std::size_t>(frame.width);
    frame.raw.resize(static_cast<std::size_t>(frame.height) * 2 / 3 * width);
  }
  return frame;
}

}  // namespace instep
