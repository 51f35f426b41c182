#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/daemon/station/scripted_set.h"
#include "tests/support/scripted_camera.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

using test::cameras;
using test::go_on;
using test::ScriptedCamera;
using test::settings;
using test::soon_over;
using test::without_end;
using Step = ScriptedCamera::Step;

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
