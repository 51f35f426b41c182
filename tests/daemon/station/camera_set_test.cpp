#include "daemon/station/camera_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <string>

#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

using test::ScriptedCamera;
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
  settings.deadline = 60s;
  return settings;
}

/// For captures that their deadline is to end.
CaptureSettings soon_over() {
  CaptureSettings soon = settings();
  soon.deadline = 400ms;
  return soon;
}

/// For captures that end before any limit, or never.
CaptureSettings without_end() {
  CaptureSettings patient = settings();
  patient.frame_limit = 1h;
  patient.deadline = 1h;
  return patient;
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

/// What a look at the cameras has reported, by camera.
class Reports {
 public:
  explicit Reports(std::size_t cameras) : outcomes_(cameras) {}
  CameraSet::Report taker() {
    return [this](std::size_t camera, Result<void> outcome) {
      const std::lock_guard lock(mutex_);
      outcomes_[camera] = std::move(outcome);
      changed_.notify_all();
    };
  }
  /// Of one camera: "" if it is well; waits for it.
  std::string of(std::size_t camera) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, 30s, [&] { return outcomes_[camera].has_value(); })) {
      return "no report";
    }
    return *outcomes_[camera] ? "" : outcomes_[camera]->error().message;
  }
  bool has_any() {
    const std::lock_guard lock(mutex_);
    return std::any_of(outcomes_.begin(), outcomes_.end(), [](const auto& one) { return !!one; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::optional<Result<void>>> outcomes_;
};

TEST(CameraSet, ReportsEachCameraWhenChecked) {
  const auto set = cameras({}, {Step::kGone});
  Reports reports(2);
  set->check(settings(), CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  EXPECT_EQ(reports.of(0), "");
  EXPECT_EQ(reports.of(1), "camera right: it left");
}

/// One whose start goes on by itself for ever.
class NeverStarted final : public ScriptedCamera {
 public:
  NeverStarted() : ScriptedCamera("slow", {}) {}
  Result<void> start() override {
    ++starts_;
    return fail(ErrorCode::kTimeout, "it is still starting", "wait a moment");
  }
  int starts() const { return starts_; }

 private:
  std::atomic<int> starts_ = 0;
};

/// It streamed on, with its projector, until somebody looked or scanned again.
TEST(CameraSet, StopsACameraWhoseStartIsGivenUpAndLeavesALateOneToTheNextLook) {
  auto owned = std::make_unique<NeverStarted>();
  auto& camera = *owned;
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  std::promise<Result<void>> looked;
  set.check({.frame_limit = 1ms}, CameraSet::ZeroFrames::kAreFaulty,
            [&](std::size_t, Result<void> outcome) { looked.set_value(std::move(outcome)); });
  EXPECT_EQ(looked.get_future().get().error().code, ErrorCode::kTimeout);
  EXPECT_EQ(camera.stops(), 0) << "to begin anew it would be as late the next time";
  // Whether it is the camera or the capture that comes to the deadline first.
  const auto late = set.capture({.deadline = 1ms}, [] { return true; });
  EXPECT_EQ(late.error().code, ErrorCode::kTimeout);
  camera.wait_until_stopped(1);
  const int before = camera.starts();
  const auto cancelled = set.capture({.deadline = 1h}, [&] { return camera.starts() == before; });
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
  ASSERT_TRUE(set.end_by(std::chrono::steady_clock::now() + 1h));
  EXPECT_EQ(camera.stops(), 2);
}

TEST(CameraSet, WaitsForACameraThatIsSlowToStart) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::make_unique<test::SlowToStart>("slow", 3));
  CameraSet set(std::move(all));
  Reports reports(1);
  set.check(without_end(), CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  EXPECT_EQ(reports.of(0), "");
}

/// One that was away when it was made.
class LateCamera final : public ScriptedCamera {
 public:
  LateCamera() : ScriptedCamera("late", {}) { description_.geometry.id = "late"; }
  const CameraDescription& description() const override { return description_; }
  Result<void> start() override {
    description_.serial = "A1";
    return ScriptedCamera::start();
  }

 private:
  CameraDescription description_;
};

TEST(CameraSet, TellsTheSerialNumberThatACameraLearntAtItsStart) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::make_unique<LateCamera>());
  CameraSet set(std::move(all));
  EXPECT_EQ(set.descriptions().at(0).serial, "");
  Reports reports(1);
  set.check(settings(), CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  EXPECT_EQ(reports.of(0), "");
  EXPECT_EQ(set.descriptions().at(0).serial, "A1");
}

// Unlike one that is still opening, it does not begin to send by being waited for.
TEST(CameraSet, HasACameraThatStreamsAndSendsNothingOpenedAgain) {
  const auto set = cameras({Step::kTimeout}, {});
  std::promise<Remedy> silent;
  set->check(settings(), CameraSet::ZeroFrames::kAreFaulty,
             [&](std::size_t camera, const Result<void>& outcome) {
               if (camera == 0) silent.set_value(outcome ? Remedy::kBug : outcome.error().remedy);
             });
  EXPECT_EQ(silent.get_future().get(), Remedy::kReopen);
}

// Every scan would fail, though it answers.
TEST(CameraSet, ReportsACameraWhoseFramesAreOfNoUse) {
  auto patient = settings();
  patient.frame_limit = 10s;
  const auto set = cameras(std::deque<Step>(100, Step::kZero), std::deque<Step>(100, Step::kShort));
  Reports reports(2);
  set->check(patient, CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  EXPECT_THAT(reports.of(0), testing::HasSubstr("camera left: it sees nothing"));
  EXPECT_THAT(reports.of(1), testing::HasSubstr("camera right: it sends damaged frames only"));

  const auto dark =
      cameras(std::deque<Step>(100, Step::kZero), std::deque<Step>(100, Step::kEmpty));
  Reports unlit(2);
  dark->check(patient, CameraSet::ZeroFrames::kAreAsExpected, unlit.taker());
  EXPECT_EQ(unlit.of(0), "");
  EXPECT_EQ(unlit.of(1), "");
}

TEST(CameraSet, PassesOverWhatAStreamMayBeginWithWhenItChecks) {
  auto patient = settings();
  patient.frame_limit = 10s;
  const auto set = cameras({Step::kCorrupt, Step::kStale, Step::kZero}, {Step::kEmpty});
  Reports reports(2);
  set->check(patient, CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  EXPECT_EQ(reports.of(0), "");
  EXPECT_EQ(reports.of(1), "") << "little is to be seen when nobody stands there";
}

TEST(CameraSet, WaitsForACameraThatIsNotBackYetWhenItChecks) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  auto owned = std::make_unique<ScriptedCamera>("slow", std::deque<Step>{Step::kHang});
  ScriptedCamera& slow = *owned;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  ASSERT_FALSE(set.capture(soon_over(), go_on));
  Reports first(1);
  set.check(settings(), CameraSet::ZeroFrames::kAreFaulty, first.taker());
  Reports second(1);
  set.check(settings(), CameraSet::ZeroFrames::kAreFaulty, second.taker());
  EXPECT_FALSE(first.has_any());
  EXPECT_FALSE(second.has_any());
  slow.release();
  EXPECT_EQ(second.of(0), "");
  EXPECT_FALSE(first.has_any()) << "who asked last is told, and once";
}

TEST(CameraSet, SaysWhetherACameraHadToBeLeftBehind) {
  std::vector<std::unique_ptr<DepthCamera>> all;
  auto owned = std::make_unique<ScriptedCamera>("waits", std::deque<Step>{Step::kTimeout});
  ScriptedCamera& waits = *owned;
  all.push_back(std::move(owned));
  CameraSet set(std::move(all));
  auto patient = settings();
  patient.frame_limit = 60s;
  Reports reports(1);
  set.check(patient, CameraSet::ZeroFrames::kAreFaulty, reports.taker());
  waits.wait_until_asked();
  EXPECT_TRUE(set.end_by(steady_clock::now() + 30s)) << "one that waits for a frame is interrupted";

  const auto hangs = cameras({Step::kHang}, {});
  ASSERT_FALSE(hangs->capture(soon_over(), go_on));
  EXPECT_FALSE(hangs->end_by(steady_clock::now()));
}

}  // namespace
}  // namespace instep
