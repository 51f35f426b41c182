#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "drivers/depth_camera.h"

namespace instep::test {

/// A camera that does what its script says, one entry a call of next_frame(); then good frames.
class ScriptedCamera : public DepthCamera {
 public:
  enum class Step {
    kGood,
    kCorrupt,
    kShort,
    kStale,
    kEmpty,
    kZero,
    kLost,
    kTimeout,
    kGone,
    kHang,
    kNoMemory,
  };

  ScriptedCamera(const std::string& id, std::deque<Step> script) : script_(std::move(script)) {
    description_.geometry.id = id;
    description_.geometry.intrinsics = {kSide_px, kSide_px, 20.0, 20.0, 9.5, 9.5};
  }
  const CameraDescription& description() const override { return description_; }
  Result<void> start() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = false;
    return {};
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override {
    std::unique_lock lock(mutex_);
    ++asked_;
    changed_.notify_all();
    Step step = Step::kGood;
    if (!script_.empty()) {
      step = script_.front();
      script_.pop_front();
    }
    if (step == Step::kHang) {
      // What no camera may do: neither its limit nor an interrupt ends this call.
      changed_.wait_for(lock, std::chrono::minutes(1), [this] { return released_; });
      return fail(ErrorCode::kTimeout, "far too late", "");
    }
    if (step == Step::kTimeout) {
      changed_.wait_for(lock, limit, [this] { return interrupted_; });
      if (interrupted_) return fail(ErrorCode::kCancelled, "interrupted", "");
      return fail(ErrorCode::kTimeout, "no frame came", "");
    }
    if (step == Step::kNoMemory) throw std::bad_alloc();
    if (step == Step::kGone) return fail(ErrorCode::kDeviceGone, "it left", "plug it in");
    return frame_of(step);
  }
  void stop() override {
    const std::lock_guard lock(mutex_);
    ++stops_;
    changed_.notify_all();
  }
  void wait_until_stopped(int times) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return stops_ >= times; });
  }
  int stops() {
    const std::lock_guard lock(mutex_);
    return stops_;
  }
  /// Returns once so many frames were asked for, of which a script may keep the last waiting.
  void wait_until_asked(int times = 1) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return asked_ >= times; });
  }
  /// Ends kHang before its time.
  void release() {
    const std::lock_guard lock(mutex_);
    released_ = true;
    changed_.notify_all();
  }
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
  }

 protected:
  virtual DepthFrame frame_of(Step step) {
    DepthFrame frame;
    frame.camera = description_.geometry.id;
    frame.width = frame.height = kSide_px;
    frame.raw.assign(kSide_px * kSide_px, 500);
    if (step == Step::kCorrupt) frame.status = FrameStatus::kCorrupt;
    if (step == Step::kStale) frame.status = FrameStatus::kStale;
    // These two, no driver says.
    if (step == Step::kShort) frame.raw.resize(frame.raw.size() / 2);
    if (step == Step::kEmpty) std::fill(frame.raw.begin() + 3, frame.raw.end(), 0);
    if (step == Step::kZero) std::fill(frame.raw.begin(), frame.raw.end(), 0);
    if (step == Step::kLost) sequence_ += 2;
    frame.sequence = sequence_++;
    return frame;
  }

 private:
  static constexpr int kSide_px = 20;

  CameraDescription description_;
  std::uint64_t sequence_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Step> script_;
  bool interrupted_ = false;
  int asked_ = 0;
  int stops_ = 0;
  bool released_ = false;
};

/// One whose start takes longer than a call may, and goes on by itself.
class SlowToStart final : public ScriptedCamera {
 public:
  SlowToStart(const std::string& id, int calls) : ScriptedCamera(id, {}), calls_(calls) {}
  Result<void> start() override {
    if (--calls_ > 0) return fail(ErrorCode::kTimeout, "it is still starting", "wait a moment");
    return ScriptedCamera::start();
  }

 private:
  int calls_;  ///< until it streams
};

}  // namespace instep::test
