#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <utility>

#include "daemon/station/camera_set.h"
#include "sim/simulated_station.h"
#include "tests/support/scripted_camera.h"

/// Cameras that take turns, because their emitters disturb each other.
namespace instep {
namespace {

using namespace std::chrono_literals;
using test::ScriptedCamera;
using Step = ScriptedCamera::Step;

CaptureSettings settings(bool one_at_a_time) {
  CaptureSettings settings;
  settings.frames_per_camera = 5;
  settings.warmup_frames = 2;
  settings.frame_limit = 200ms;
  settings.deadline = 5s;
  settings.one_at_a_time = one_at_a_time;
  return settings;
}

bool go_on() {
  return true;
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
  for (int scan = 0; scan < 3; ++scan) {
    const auto frames = set.capture(settings(one_at_a_time), go_on);
    EXPECT_TRUE(frames || !fault_script.empty()) << frames.error().line();
  }
  return light->most;
}

// No two sensors are ever lit at once, whatever goes wrong. An emitter is lit while its sensor
// streams: streaming in turn is what switches it.
TEST(CameraTurns, SequentialCaptureMode) {
  EXPECT_EQ(most_lit("", true), 1);
  EXPECT_EQ(most_lit("camera all: stall after 4 frames for 500 ms\n"
                     "camera all: vanish after 9 frames, return after 300 ms\n"
                     "camera all: corrupt frames 11-13\n",
                     true),
            1);
  EXPECT_GT(most_lit("", false), 1) << "this would see two that are lit";
}

// A camera that is still being looked at is lit as well.
TEST(CameraTurns, BeginWhenNoCameraIsLookedAtAnyMore) {
  const auto light = std::make_shared<LitCamera::Light>();
  auto silent = std::make_unique<ScriptedCamera>("right", std::deque{Step::kTimeout});
  ScriptedCamera& right = *silent;
  std::vector<std::unique_ptr<DepthCamera>> all;
  all.push_back(std::make_unique<LitCamera>(
      std::make_unique<ScriptedCamera>("left", std::deque<Step>()), light));
  all.push_back(std::make_unique<LitCamera>(std::move(silent), light));
  CameraSet set(std::move(all));
  light->counting = false;
  const auto left_done = std::make_shared<std::promise<void>>();
  auto patient = settings(true);
  patient.frame_limit = 60s;
  patient.deadline = 60s;
  set.check(patient, CameraSet::ZeroFrames::kAreFaulty,
            [left_done](std::size_t camera, const Result<void>&) {
              if (camera == 0) left_done->set_value();
            });
  left_done->get_future().wait();
  right.wait_until_asked();
  {
    const std::lock_guard lock(light->mutex);
    ASSERT_EQ(light->lit, 1) << "the right one, for as long as it is silent";
    light->counting = true;
    light->most = 0;
  }
  // The look ends only when the scan has been under way for a while: a left camera that did not
  // wait for that would be lit beside the right one.
  int asked = 0;
  const auto frames = set.capture(patient, [&] {
    constexpr int kWhileItWaits = 5;
    if (++asked == kWhileItWaits) right.interrupt();
    return true;
  });
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 10U);
  EXPECT_EQ(light->most, 1);
}

}  // namespace
}  // namespace instep
