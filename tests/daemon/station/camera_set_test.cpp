#include "daemon/station/camera_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <utility>

#include "sim/simulated_station.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

/// A camera that does what its script says, one entry a call of next_frame(); then good frames.
class ScriptedCamera : public DepthCamera {
 public:
  enum class Step { kGood, kCorrupt, kShort, kStale, kEmpty, kLost, kTimeout, kGone, kHang };

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
    return frame_of(step);
  }
  void stop() override {}
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
    changed_.notify_all();
  }

 protected:
  virtual DepthFrame frame_of(Step step) {
    constexpr int kSide_px = 20;
    DepthFrame frame;
    frame.camera = description_.geometry.id;
    frame.width = frame.height = kSide_px;
    frame.raw.assign(kSide_px * kSide_px, 500);
    if (step == Step::kCorrupt) frame.status = FrameStatus::kCorrupt;
    if (step == Step::kStale) frame.status = FrameStatus::kStale;
    // These two, no driver says.
    if (step == Step::kShort) frame.raw.resize(frame.raw.size() / 2);
    if (step == Step::kEmpty) std::fill(frame.raw.begin() + 3, frame.raw.end(), 0);
    if (step == Step::kLost) sequence_ += 2;
    frame.sequence = sequence_++;
    return frame;
  }

 private:
  CameraDescription description_;
  std::uint64_t sequence_ = 0;
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

// D22
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

// D18: by their count, in each stream anew.
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

// D19
TEST(CameraSet, ZeroFrameIsRejected) {
  const auto set = cameras({Step::kGood, Step::kGood, Step::kEmpty, Step::kEmpty},
                           std::deque<Step>(100, Step::kEmpty));
  auto patient = settings();
  auto frames = set->capture(patient, go_on);
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().remedy, Remedy::kReset);
  EXPECT_THAT(frames.error().message, testing::HasSubstr("camera right: it sees nothing"));
  EXPECT_EQ(set->frame_counts(0).empty, 2U);

  const auto sound = cameras({Step::kGood, Step::kGood, Step::kEmpty, Step::kEmpty}, {});
  frames = sound->capture(patient, go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
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
  EXPECT_EQ(set->frame_counts(1).damaged(), 0U);
  EXPECT_EQ(set->frame_counts(1).good, 7U);
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

/// Notes how many cameras have their emitter lit at a time: from the call that starts a stream to
/// the end of the one that stops it, whatever comes of them. Gives the others time to join in.
class LitCamera final : public DepthCamera {
 public:
  struct Light {
    std::mutex mutex;
    std::condition_variable changed;
    int lit = 0;
    int most = 0;
    bool counting = true;

    void look() {
      if (counting) most = std::max(most, lit);
      changed.notify_all();
    }
  };

  LitCamera(std::unique_ptr<DepthCamera> camera, std::shared_ptr<Light> light)
      : camera_(std::move(camera)), light_(std::move(light)) {}

  const CameraDescription& description() const override { return camera_->description(); }
  Result<void> start() override {
    {
      const std::lock_guard lock(light_->mutex);
      if (!std::exchange(lit_, true)) ++light_->lit;
      light_->look();
    }
    return camera_->start();
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override {
    {
      std::unique_lock lock(light_->mutex);
      light_->look();
      light_->changed.wait_for(lock, 10ms, [this] { return light_->most > 1; });
    }
    return camera_->next_frame(limit);
  }
  void stop() override {
    camera_->stop();
    const std::lock_guard lock(light_->mutex);
    if (std::exchange(lit_, false)) --light_->lit;
  }
  void interrupt() override { camera_->interrupt(); }

 private:
  std::unique_ptr<DepthCamera> camera_;
  std::shared_ptr<Light> light_;
  bool lit_ = false;
};

/// The most of the cameras of a simulated station that were lit at a time, in three scans.
int most_lit(const std::string& fault_script, bool one_at_a_time) {
  SimulationSettings simulation;
  simulation.width_px = 64;
  simulation.height_px = 48;
  simulation.pacing = Pacing::kAsFastAsPossible;
  simulation.fault_script = fault_script;
  auto station = build_station(simulation).value();
  const auto light = std::make_shared<LitCamera::Light>();
  std::vector<std::unique_ptr<DepthCamera>> all;
  for (auto& camera : station.cameras) {
    all.push_back(std::make_unique<LitCamera>(std::move(camera), light));
  }
  CameraSet set(std::move(all));
  auto quick = settings();
  quick.deadline = 5s;
  quick.frame_limit = 200ms;
  quick.one_at_a_time = one_at_a_time;
  for (int scan = 0; scan < 3; ++scan) {
    const auto frames = set.capture(quick, go_on);
    EXPECT_TRUE(frames || !fault_script.empty()) << frames.error().line();
  }
  return light->most;
}

// D20: no two sensors are ever lit at once, whatever goes wrong. An emitter is lit while its sensor
// streams: streaming in turn is what switches it.
TEST(CameraSet, SequentialCaptureMode) {
  EXPECT_EQ(most_lit("", true), 1);
  EXPECT_EQ(most_lit("camera all: stall after 4 frames for 500 ms\n"
                     "camera all: vanish after 9 frames, return after 300 ms\n"
                     "camera all: corrupt frames 11-13\n",
                     true),
            1);
  EXPECT_GT(most_lit("", false), 1) << "this would see two that are lit";
}

// D20: a camera that is still being looked at is lit as well.
TEST(CameraSet, TurnsBeginWhenNoCameraIsLookedAtAnyMore) {
  const auto light = std::make_shared<LitCamera::Light>();
  std::vector<std::unique_ptr<DepthCamera>> all;
  for (const auto& [id, script] :
       {std::pair("left", std::deque<Step>()), std::pair("right", std::deque{Step::kTimeout})}) {
    all.push_back(std::make_unique<LitCamera>(std::make_unique<ScriptedCamera>(id, script), light));
  }
  CameraSet set(std::move(all));
  light->counting = false;
  const auto left_done = std::make_shared<std::promise<void>>();
  set.check(300ms, [left_done](std::size_t camera, const Result<void>&) {
    if (camera == 0) left_done->set_value();
  });
  left_done->get_future().wait();
  {
    std::unique_lock lock(light->mutex);
    ASSERT_TRUE(light->changed.wait_for(lock, 5s, [&] { return light->lit == 1; }))
        << "the right one, for as long as it is silent";
    light->counting = true;
    light->most = 0;
  }
  auto in_turn = settings();
  in_turn.deadline = 5s;
  in_turn.one_at_a_time = true;
  const auto frames = set.capture(in_turn, go_on);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
  EXPECT_EQ(light->most, 1);
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
