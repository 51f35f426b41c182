#include "daemon/station/camera_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "tests/daemon/station/scripted_set.h"
#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

using test::cameras;
using test::go_on;
using test::ScriptedCamera;
using test::settings;
using test::soon_over;
using test::without_end;
using Step = ScriptedCamera::Step;

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

// One camera drops out while several are read.
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
  auto quick = soon_over();
  quick.frame_limit = 60s;
  const auto frames = set->capture(quick, go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("left, right"));
}

// The other one was interrupted for it, and is on its way back.
TEST(CameraSet, NamesTheCameraThatFailedAndNotTheOneThatWaitsForAFrame) {
  const auto set = cameras({Step::kGone, Step::kGone}, std::deque<Step>(20, Step::kTimeout));
  const auto frames = set->capture(without_end(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().message, "camera left: it left");
}

/// It was told as two.
TEST(CameraSet, NamesACameraWithACommaOnce) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  const std::deque<Step> script = {Step::kGone, Step::kGone};
  all.push_back(std::make_unique<ScriptedCamera>("left, top", script));
  CameraSet set(std::move(all));
  const auto frames = set.capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().message, "camera left, top: it left");
}

/// Tells how often it was started, and throws where it is to be stopped.
class CountedCamera final : public ScriptedCamera {
 public:
  using ScriptedCamera::ScriptedCamera;
  Result<void> start() override {
    ++starts;
    return ScriptedCamera::start();
  }
  void stop() override {
    if (throws) throw std::bad_alloc();
  }

  std::atomic<int> starts = 0;
  bool throws = false;
};

/// It was started for frames that nobody waited for, and kept the next scan waiting meanwhile.
TEST(CameraSet, IsNotStartedForAScanThatWasGivenUp) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  auto owned = std::make_unique<CountedCamera>("hangs", std::deque<Step>{Step::kHang});
  CountedCamera& hangs = *owned;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  ASSERT_FALSE(set.capture(soon_over(), go_on));
  ASSERT_FALSE(set.capture(without_end(), [] { return false; }));
  hangs.release();
  EXPECT_TRUE(set.capture(settings(), go_on));
  EXPECT_EQ(hangs.starts, 2) << "the first and the last";
}

/// On its thread that would end the daemon.
TEST(CameraSet, OutlivesACameraThatThrowsWhenItIsStopped) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  auto owned = std::make_unique<CountedCamera>("only", std::deque<Step>{});
  owned->throws = true;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  const auto frames = set.capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().line(), testing::HasSubstr("not enough memory"));
}

/// Sends wrong depth at the beginning of each stream, and says nothing of it.
class SettlingCamera : public ScriptedCamera {
 public:
  static constexpr int kSettling = 3;

  using ScriptedCamera::ScriptedCamera;
  Result<void> start() override {
    sent_ = 0;
    return ScriptedCamera::start();
  }

 protected:
  DepthFrame frame_of(Step step) override {
    DepthFrame frame = ScriptedCamera::frame_of(step);
    if (sent_++ < kSettling) std::fill(frame.raw.begin(), frame.raw.end(), 9);
    return frame;
  }

 private:
  int sent_ = 0;
};

// By their count, in each stream anew.
TEST(CameraSet, WarmupFramesAreDiscarded) {
  for (const int warmup : {SettlingCamera::kSettling - 1, SettlingCamera::kSettling}) {
    std::vector<std::unique_ptr<DepthCamera>> all;
    // The first attempt fails, so that the set is taken once more.
    const std::deque<Step> script = {Step::kGood, Step::kGood, Step::kGood, Step::kGood,
                                     Step::kGone};
    all.push_back(std::make_unique<SettlingCamera>("only", script));
    CameraSet set(std::move(all));
    auto warming = settings();
    warming.warmup_frames = warmup;
    for (int scan = 0; scan < 2; ++scan) {
      const auto frames = set.capture(warming, go_on);
      ASSERT_TRUE(frames) << frames.error().line();
      ASSERT_EQ(frames->size(), 5U);
      const auto wrong = std::count_if(frames->begin(), frames->end(),
                                       [](const auto& frame) { return frame.raw[0] == 9; });
      EXPECT_EQ(wrong, SettlingCamera::kSettling - warmup);
    }
  }
}

// After hours some cameras send frames without a depth.
TEST(CameraSet, ZeroFrameIsRejected) {
  const auto set = cameras({Step::kGood, Step::kGood, Step::kEmpty, Step::kEmpty},
                           std::deque<Step>(100, Step::kEmpty));
  auto patient = settings();
  auto frames = set->capture(patient, go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().remedy, Remedy::kReset);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera right: it sees nothing"));

  const auto sound = cameras({Step::kGood, Step::kGood, Step::kEmpty, Step::kEmpty}, {});
  frames = sound->capture(patient, go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
  EXPECT_EQ(sound->frame_counts(0).empty, 2U);
  for (const auto& frame : *frames) EXPECT_EQ(frame.raw.back(), 500) << frame.camera;
}

TEST(CameraSet, CountsWhatIsWrongWithTheFramesOfEachCamera) {
  const auto set = cameras({Step::kCorrupt, Step::kGood, Step::kCorrupt, Step::kShort, Step::kStale,
                            Step::kEmpty, Step::kLost, Step::kShort, Step::kShort},
                           {});
  const auto frames = set->capture(settings(), go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
  const auto left = set->frame_counts(0);
  EXPECT_EQ(left.error_flagged, 2U) << "one of them while it warmed up";
  EXPECT_EQ(left.short_of_pixels, 3U);
  EXPECT_EQ(left.stale, 1U);
  EXPECT_EQ(left.empty, 1U);
  EXPECT_EQ(left.lost, 2U);
  EXPECT_EQ(left.good, 6U);
  const auto right = set->frame_counts(1);
  EXPECT_EQ(right.good, 7U);
  EXPECT_EQ(right.error_flagged + right.short_of_pixels + right.stale + right.empty, 0U);
}

/// On the thread of its camera, where nobody caught it, it ended the daemon.
TEST(CameraSet, SaysThatThereIsNotEnoughMemory) {
  const auto set = cameras({Step::kGood, Step::kNoMemory, Step::kNoMemory}, {});
  const auto frames = set->capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().line(), testing::HasSubstr("not enough memory"));
  EXPECT_THAT(frames.error().line(), testing::HasSubstr("frames_per_camera"));
  EXPECT_TRUE(set->capture(settings(), go_on)) << "there is enough again";
}

TEST(CameraSet, GivesUpOnACameraThatSendsDamagedFramesOnly) {
  const auto set = cameras({}, std::deque<Step>(100, Step::kCorrupt));
  const auto frames = set->capture(settings(), go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().remedy, Remedy::kReset);
}

TEST(CameraSet, ReturnsByItsDeadlineThoughACameraHangs) {
  const auto set = cameras({Step::kHang}, {});
  const auto frames = set->capture(soon_over(), go_on);
  ASSERT_FALSE(frames);
  // It would have its own words, had it been waited for.
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera left does not answer"));
}

TEST(CameraSet, StopsWhenCancelledWithoutWaitingForItsLimits) {
  const std::deque<Step> silent(20, Step::kTimeout);
  const auto set = cameras(silent, silent);
  int asked = 0;
  const auto frames = set->capture(without_end(), [&] { return ++asked < 3; });
  EXPECT_EQ(asked, 3);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kCancelled);
}

TEST(CameraSet, EndsTurnsWhenACameraFailsOrTheScanIsStopped) {
  const auto set = cameras(std::deque<Step>(20, Step::kTimeout), {});
  auto in_turn = settings();
  in_turn.one_at_a_time = true;
  const auto frames = set->capture(in_turn, go_on);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera left"));
  EXPECT_EQ(frames.error().message.find("right"), std::string::npos);
  in_turn = without_end();
  in_turn.one_at_a_time = true;
  EXPECT_FALSE(set->capture(in_turn, [] { return false; }));
}

}  // namespace
}  // namespace instep
