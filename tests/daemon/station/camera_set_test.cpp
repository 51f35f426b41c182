#include "daemon/station/camera_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace instep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// A camera that does what its script says, one entry a call of next_frame(); then good frames.
class ScriptedCamera : public DepthCamera {
 public:
  enum class Step { kGood, kCorrupt, kTimeout, kGone, kHang };

  ScriptedCamera(const std::string& id, std::deque<Step> script) : script_(std::move(script)) {
    description_.geometry.id = id;
  }
  const CameraDescription& description() const override { return description_; }
  Result<void> start() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = false;
    return {};
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override {
    std::unique_lock lock(mutex_);
    Step step = Step::kGood;
    if (!script_.empty()) {
      step = script_.front();
      script_.pop_front();
    }
    if (step == Step::kHang) {
      // What no camera may do: neither its limit nor an interrupt ends this call.
      changed_.wait_for(lock, 3s, [this] { return released_; });
      return fail(ErrorCode::kTimeout, "far too late", "");
    }
    if (step == Step::kTimeout) {
      changed_.wait_for(lock, limit, [this] { return interrupted_; });
      if (interrupted_) return fail(ErrorCode::kCancelled, "interrupted", "");
      return fail(ErrorCode::kTimeout, "no frame came", "");
    }
    if (step == Step::kGone) return fail(ErrorCode::kDeviceGone, "it left", "plug it in");
    DepthFrame frame;
    frame.camera = description_.geometry.id;
    frame.status = step == Step::kGood ? FrameStatus::kGood : FrameStatus::kCorrupt;
    return frame;
  }
  void stop() override {}
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
  }

 private:
  CameraDescription description_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Step> script_;
  bool interrupted_ = false;
  bool released_ = false;
};

using Step = ScriptedCamera::Step;

std::unique_ptr<CameraSet> cameras(std::deque<Step> left, std::deque<Step> right) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::make_unique<ScriptedCamera>("left", std::move(left)));
  all.push_back(std::make_unique<ScriptedCamera>("right", std::move(right)));
  return std::make_unique<CameraSet>(std::move(all));
}

CaptureSettings settings() {
  CaptureSettings settings;
  settings.frames_per_camera = 5;
  settings.warmup_frames = 2;
  settings.frame_limit = 50ms;
  settings.deadline = 400ms;
  return settings;
}

bool go_on() {
  return true;
}

TEST(CameraSet, BringsTheGoodFramesOfAllCameras) {
  const auto set = cameras({Step::kGood, Step::kCorrupt, Step::kCorrupt, Step::kGood}, {});
  const auto frames = set->capture(settings(), go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
  for (const auto& frame : *frames) EXPECT_EQ(frame.status, FrameStatus::kGood);
}

TEST(CameraSet, TakesTheWholeSetOnceMoreWhenACameraFails) {
  const auto set = cameras({Step::kGood, Step::kGood, Step::kGood, Step::kGone}, {});
  const auto frames = set->capture(settings(), go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
}

TEST(CameraSet, NamesTheCameraRatherThanReturnAPartialSet) {
  const auto set = cameras({}, {Step::kGone, Step::kGone});
  const auto frames = set->capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kDeviceGone);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera right"));
}

TEST(CameraSet, NamesAllCamerasThatFail) {
  const std::deque<Step> silent(20, Step::kTimeout);
  const auto set = cameras(silent, silent);
  auto quick = settings();
  quick.frame_limit = 1000ms;
  const auto frames = set->capture(quick, go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("left, right"));
}

TEST(CameraSet, GivesUpOnACameraThatSendsDamagedFramesOnly) {
  const auto set = cameras({}, std::deque<Step>(100, Step::kCorrupt));
  const auto frames = set->capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().remedy, Remedy::kReset);
}

TEST(CameraSet, ReturnsByItsDeadlineEvenIfACameraHangs) {
  const auto set = cameras({Step::kHang}, {});
  const auto begun = steady_clock::now();
  const auto frames = set->capture(settings(), go_on);
  EXPECT_LT(steady_clock::now() - begun, 1500ms);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera left does not answer"));
}

TEST(CameraSet, StopsWithinASecondWhenCancelled) {
  const std::deque<Step> silent(20, Step::kTimeout);
  const auto set = cameras(silent, silent);
  auto patient = settings();
  patient.frame_limit = 10s;
  patient.deadline = 60s;
  const auto begun = steady_clock::now();
  int asked = 0;
  const auto frames = set->capture(patient, [&] { return ++asked < 3; });
  EXPECT_LT(steady_clock::now() - begun, 1s);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kCancelled);
}

/// Notes the most cameras that stream at a time. Each gives the others some time to join in.
class CountedCamera : public ScriptedCamera {
 public:
  struct Count {
    std::mutex mutex;
    std::condition_variable changed;
    int streaming = 0;
    int most = 0;
  };

  CountedCamera(const std::string& id, std::deque<Step> script, std::shared_ptr<Count> count)
      : ScriptedCamera(id, std::move(script)), count_(std::move(count)) {}

  Result<void> start() override {
    const std::lock_guard lock(count_->mutex);
    count_->most = std::max(count_->most, ++count_->streaming);
    count_->changed.notify_all();
    return ScriptedCamera::start();
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override {
    std::unique_lock lock(count_->mutex);
    count_->changed.wait_for(lock, 10ms, [this] { return count_->most > 1; });
    lock.unlock();
    return ScriptedCamera::next_frame(limit);
  }
  void stop() override {
    const std::lock_guard lock(count_->mutex);
    --count_->streaming;
  }

 private:
  std::shared_ptr<Count> count_;
};

TEST(CameraSet, SequentialCaptureMode) {
  const auto count = std::make_shared<CountedCamera::Count>();
  std::vector<std::unique_ptr<DepthCamera>> all;
  for (const auto* id : {"front", "left", "back", "right"}) {
    all.push_back(std::make_unique<CountedCamera>(
        id, std::deque<Step>{Step::kGood, Step::kGood, Step::kCorrupt}, count));
  }
  CameraSet set(std::move(all));
  auto in_turn = settings();
  in_turn.deadline = 5s;
  in_turn.one_at_a_time = true;
  const auto frames = set.capture(in_turn, go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 20U);
  EXPECT_EQ(count->most, 1);
}

TEST(CameraSet, EndsTurnsWhenACameraFailsOrTheScanIsStopped) {
  const auto set = cameras(std::deque<Step>(20, Step::kTimeout), {});
  auto in_turn = settings();
  in_turn.one_at_a_time = true;
  const auto frames = set->capture(in_turn, go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera left"));
  EXPECT_EQ(frames.error().message.find("right"), std::string::npos);
  in_turn.frame_limit = 10s;
  in_turn.deadline = 60s;
  const auto begun = steady_clock::now();
  EXPECT_FALSE(set->capture(in_turn, [] { return false; }));
  EXPECT_LT(steady_clock::now() - begun, 1s);
}

TEST(CameraSet, ReportsEachCameraWhenChecked) {
  const auto set = cameras({}, {Step::kGone});
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::optional<bool>> well(2);
  set->check(100ms, [&](std::size_t camera, Result<void> outcome) {
    const std::lock_guard lock(mutex);
    well[camera] = outcome.has_value();
    changed.notify_all();
  });
  std::unique_lock lock(mutex);
  ASSERT_TRUE(changed.wait_for(lock, 5s, [&] { return well[0] && well[1]; }));
  EXPECT_TRUE(*well[0]);
  EXPECT_FALSE(*well[1]);
}

}  // namespace
}  // namespace instep
