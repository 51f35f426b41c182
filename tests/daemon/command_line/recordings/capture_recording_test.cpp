#include "daemon/command_line/recordings/capture_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <deque>
#include <filesystem>
#include <map>
#include <utility>

#include "daemon/command_line/stop_request.h"
#include "drivers/recording/recording_reader.h"
#include "sim/simulated_station.h"
#include "tests/support/model_board.h"
#include "tests/support/scripted_camera.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

SimulatedStation small_station() {
  SimulationSettings settings;
  settings.cameras = 2;
  settings.width_px = 64;
  settings.height_px = 48;
  settings.pacing = Pacing::kAsFastAsPossible;
  return build_station(settings).value();
}

// As `instep record` does it: the signal arrives in the midst of the frames.
TEST(CaptureRecording, EndsAtASignalWithTheLightOffAndNothingKept) {
  const auto station = small_station();
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const test::TemporaryFolder folder;
    test::ModelBoard board;
    int rounds = 0;
    {
      const StopRequest stop;
      const auto light = board.open("projector").value();
      ASSERT_TRUE(light->set(true));
      const auto recording = capture_recording(station.cameras, {}, {.length = {10000, {}}},
                                               folder.path() / "visit", [&](double) {
                                                 EXPECT_TRUE(board.is_on("projector"));
                                                 if (++rounds == 3) raise(number);
                                                 return !stop.is_made();
                                               });
      ASSERT_FALSE(recording);
      EXPECT_EQ(recording.error().code, ErrorCode::kCancelled);
    }
    EXPECT_EQ(rounds, 3);
    EXPECT_FALSE(board.is_on("projector"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "visit"));
  }
}

using Cameras = std::vector<std::unique_ptr<DepthCamera>>;
using Step = test::ScriptedCamera::Step;

bool go_on(double) {
  return true;
}

/// The frames of each camera, by its name.
std::map<std::string, std::vector<RecordedFrame>> frames_of(const Recording& recording) {
  std::map<std::string, std::vector<RecordedFrame>> frames;
  for (const auto& frame : recording.frames) frames[frame.camera].push_back(frame);
  return frames;
}

Cameras two_cameras(const std::deque<Step>& script_of_second) {
  Cameras cameras;
  cameras.push_back(std::make_unique<test::ScriptedCamera>("a", std::deque<Step>()));
  cameras.push_back(std::make_unique<test::ScriptedCamera>("b", script_of_second));
  return cameras;
}

/// It could never be recorded, though it only needed to be asked again.
TEST(CaptureRecording, WaitsForACameraThatIsSlowToStartUnlessItIsStopped) {
  const test::TemporaryFolder folder;
  for (const auto turns : {CameraTurns::kTogether, CameraTurns::kOneAtATime}) {
    Cameras cameras;
    cameras.push_back(std::make_unique<test::SlowToStart>("slow", 4));
    const RecordingPlan plan = {.length = {2, {}}, .turns = turns};
    const auto stopped = capture_recording(cameras, {}, plan, folder.path() / "stopped",
                                           [](double) { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().message, recording_stopped().message);
    const auto to = folder.path() / (turns == CameraTurns::kTogether ? "together" : "in turns");
    const auto recording = capture_recording(cameras, {}, plan, to, go_on);
    ASSERT_TRUE(recording) << recording.error().line();
    EXPECT_EQ(recording->frames.size(), 2U);
  }
}

TEST(CaptureRecording, LeavesOutTheFramesThatAScanLeavesOut) {
  const test::TemporaryFolder folder;
  const auto cameras = two_cameras(
      {Step::kShort, Step::kGood, Step::kEmpty, Step::kStale, Step::kCorrupt, Step::kGood});
  ASSERT_TRUE(capture_recording(cameras, {}, {.length = {3, {}}}, folder.path() / "visit", go_on));
  const auto recording = read_recording(folder.path() / "visit").value();
  const auto frames = read_recorded_frames(recording);
  ASSERT_TRUE(frames) << frames.error().line();
  EXPECT_EQ(frames->size(), 6U);
  for (const auto& frame : *frames) {
    EXPECT_EQ(std::count(frame.raw.begin(), frame.raw.end(), 500), 400) << frame.camera;
  }
}

TEST(CaptureRecording, TellsWhatIsWrongWithACameraOfFaultyFrames) {
  for (const auto& [step, said] : {std::pair{Step::kEmpty, "camera b: it sees nothing"},
                                   std::pair{Step::kShort, "camera b: it sends damaged frames"}}) {
    for (const auto turns : {CameraTurns::kTogether, CameraTurns::kOneAtATime}) {
      const test::TemporaryFolder folder;
      const auto recording =
          capture_recording(two_cameras(std::deque<Step>(100, step)), {},
                            {.length = {3, {}}, .turns = turns}, folder.path() / "visit", go_on);
      ASSERT_FALSE(recording);
      EXPECT_EQ(recording.error().code, ErrorCode::kCorruptData);
      EXPECT_THAT(recording.error().message, testing::HasSubstr(said));
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "visit"));
    }
  }
}

TEST(CaptureRecording, NamesACameraThatSendsNoFrame) {
  for (const int warmup_frames : {0, 1}) {
    for (const auto turns : {CameraTurns::kTogether, CameraTurns::kOneAtATime}) {
      const test::TemporaryFolder folder;
      RecordingPlan plan{.length = {3, {}}, .turns = turns};
      plan.warmup_frames = warmup_frames;
      const auto recording =
          capture_recording(two_cameras({Step::kGone}), {}, plan, folder.path() / "visit", go_on);
      ASSERT_FALSE(recording);
      EXPECT_EQ(recording.error().message, "camera b: it left");
    }
  }
}

/// Counts how many of its kind stream at a time.
class CountedCamera final : public DepthCamera {
 public:
  struct Count {
    int streaming = 0;
    int most = 0;
  };

  CountedCamera(std::unique_ptr<DepthCamera> camera, Count& count)
      : camera_(std::move(camera)), count_(count) {}
  const CameraDescription& description() const override { return camera_->description(); }
  Result<void> start() override {
    if (!std::exchange(streams_, true)) ++count_.streaming;
    count_.most = std::max(count_.most, count_.streaming);
    return camera_->start();
  }
  Result<DepthFrame> next_frame(std::chrono::milliseconds limit) override {
    return camera_->next_frame(limit);
  }
  void stop() override {
    camera_->stop();
    if (std::exchange(streams_, false)) --count_.streaming;
  }
  void interrupt() override { camera_->interrupt(); }

 private:
  std::unique_ptr<DepthCamera> camera_;
  Count& count_;
  bool streams_ = false;
};

TEST(CaptureRecording, LightsOneCameraAtATimeWhereTheyDisturbEachOther) {
  using namespace std::chrono_literals;
  for (const auto& length : {RecordingLength{4, {}}, RecordingLength{{}, 200ms}}) {
    std::map<CameraTurns, std::size_t> frames;
    for (const auto turns : {CameraTurns::kTogether, CameraTurns::kOneAtATime}) {
      const test::TemporaryFolder folder;
      auto station = small_station();
      CountedCamera::Count count;
      Cameras cameras;
      for (auto& camera : station.cameras) {
        cameras.push_back(std::make_unique<CountedCamera>(std::move(camera), count));
      }
      std::vector<double> told;
      const auto recording = capture_recording(cameras, {}, {.length = length, .turns = turns},
                                               folder.path() / "visit", [&](double done) {
                                                 told.push_back(done);
                                                 return true;
                                               });
      ASSERT_TRUE(recording) << recording.error().line();
      EXPECT_EQ(count.most, turns == CameraTurns::kTogether ? 2 : 1);
      EXPECT_EQ(count.streaming, 0);
      EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
      EXPECT_EQ(told.back(), 1.0);
      EXPECT_EQ(frames_of(*recording).size(), 2U);
      for (const auto& [camera, own] : frames_of(*recording)) {
        if (length.time) {
          EXPECT_GE(own.back().time - own.front().time, *length.time) << camera;
        } else {
          EXPECT_EQ(own.size(), 4U) << camera;
        }
      }
      frames[turns] = recording->frames.size();
    }
    EXPECT_EQ(frames[CameraTurns::kOneAtATime], frames[CameraTurns::kTogether]);
  }
}

/// A camera that takes a frame every 30 ms of the world, which it tells by a clock of its own; each
/// comes to this machine a while after it was taken.
class ClockedCamera final : public test::ScriptedCamera {
 public:
  struct Clock {
    std::chrono::microseconds first_frame;       ///< when it is taken, in the world
    std::chrono::microseconds own_ahead;         ///< of the world's
    std::deque<std::chrono::microseconds> late;  ///< of each frame in turn; then ever 5 ms
  };

  ClockedCamera(const std::string& id, Clock clock)
      : ScriptedCamera(id, {}), clock_(std::move(clock)) {}

 private:
  DepthFrame frame_of(Step step) override {
    using namespace std::chrono_literals;
    auto frame = ScriptedCamera::frame_of(step);
    const auto taken = clock_.first_frame + 30ms * frame.sequence;
    frame.device_time = taken + clock_.own_ahead;
    frame.host_time = std::chrono::steady_clock::time_point(taken + late());
    return frame;
  }
  std::chrono::microseconds late() {
    if (clock_.late.empty()) return std::chrono::milliseconds(5);
    const auto late = clock_.late.front();
    clock_.late.pop_front();
    return late;
  }

  Clock clock_;
};

Cameras two_clocked_cameras(std::chrono::microseconds second_is_later) {
  using namespace std::chrono_literals;
  const ClockedCamera::Clock first{1h, -59min, {20ms, 4ms, 11ms}};
  const ClockedCamera::Clock second{1h + second_is_later, 26h, {4ms, 50ms, 9ms}};
  Cameras cameras;
  cameras.push_back(std::make_unique<ClockedCamera>("a", first));
  cameras.push_back(std::make_unique<ClockedCamera>("b", second));
  return cameras;
}

TEST(CaptureRecording, PutsTheFramesOfAllCamerasOnOneClock) {
  using namespace std::chrono_literals;
  // The second may be the earlier one, and in turns is later by far.
  for (const auto& [turns, later] :
       {std::pair{CameraTurns::kTogether, 12ms}, std::pair{CameraTurns::kTogether, -12ms},
        std::pair{CameraTurns::kOneAtATime, 700ms}}) {
    const test::TemporaryFolder folder;
    const auto recording = capture_recording(
        two_clocked_cameras(later), {}, {.length = {4, {}}, .turns = turns, .warmup_frames = 2},
        folder.path() / "visit", go_on);
    ASSERT_TRUE(recording) << recording.error().line();
    auto frames = frames_of(*recording);
    ASSERT_EQ(frames["a"].size(), 4U);
    ASSERT_EQ(frames["b"].size(), 4U);
    EXPECT_EQ(std::min(frames["a"].front().time, frames["b"].front().time), 0ms);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(frames["b"][i].time - frames["a"][i].time, later) << "frame " << i;
      EXPECT_EQ(frames["a"][i].time - frames["a"].front().time, 30ms * i);
    }
  }
}

TEST(CaptureRecording, KeepsTheTimesOfCamerasThatHaveOneClock) {
  using namespace std::chrono_literals;
  const test::TemporaryFolder folder;
  Cameras cameras;
  // What this machine is late by tells nothing then.
  cameras.push_back(std::make_unique<ClockedCamera>("a", ClockedCamera::Clock{1h, 2h, {90ms}}));
  cameras.push_back(std::make_unique<ClockedCamera>("b", ClockedCamera::Clock{1h, 2h, {}}));
  const auto recording =
      capture_recording(cameras, {}, {.length = {2, {}}, .clocks = CameraClocks::kOneForAll},
                        folder.path() / "visit", go_on);
  ASSERT_TRUE(recording) << recording.error().line();
  for (const auto& [camera, own] : frames_of(*recording)) {
    EXPECT_EQ(own.front().time, 0ms) << camera;
    EXPECT_EQ(own.back().time, 30ms) << camera;
  }
}

/// Each frame holds its own number, as its depth.
class NumberedCamera final : public test::ScriptedCamera {
 public:
  using ScriptedCamera::ScriptedCamera;

 private:
  DepthFrame frame_of(Step step) override {
    auto frame = ScriptedCamera::frame_of(step);
    std::fill(frame.raw.begin(), frame.raw.end(), static_cast<std::uint16_t>(1 + frame.sequence));
    return frame;
  }
};

// A faulty one among them is one of them.
TEST(CaptureRecording, LeavesOutWhatWarmsACameraUp) {
  for (const auto turns : {CameraTurns::kTogether, CameraTurns::kOneAtATime}) {
    const test::TemporaryFolder folder;
    Cameras cameras;
    const std::deque<Step> script{Step::kGood, Step::kCorrupt, Step::kGood};
    cameras.push_back(std::make_unique<NumberedCamera>("a", script));
    cameras.push_back(std::make_unique<NumberedCamera>("b", std::deque<Step>()));
    ASSERT_TRUE(capture_recording(cameras, {},
                                  {.length = {2, {}}, .turns = turns, .warmup_frames = 3},
                                  folder.path() / "visit", go_on));
    const auto recording = read_recording(folder.path() / "visit").value();
    std::map<std::string, std::vector<int>> numbers;
    const auto frames = read_recorded_frames(recording);
    ASSERT_TRUE(frames) << frames.error().line();
    for (const auto& frame : *frames) {
      numbers[frame.camera].push_back(frame.raw.front());
    }
    EXPECT_THAT(numbers["a"], testing::ElementsAre(4, 5));
    EXPECT_THAT(numbers["b"], testing::ElementsAre(4, 5));
  }
}

TEST(StopRequest, LeavesSignalsAsTheyWere) {
  const auto handler_of = [](int number) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    return now.sa_handler;
  };
  for (int round = 0; round < 2; ++round) {
    {
      const StopRequest stop;
      EXPECT_FALSE(stop.is_made());
      EXPECT_NE(handler_of(SIGINT), SIG_DFL);
      raise(SIGINT);
      EXPECT_TRUE(stop.is_made());
      EXPECT_EQ(handler_of(SIGINT), SIG_DFL) << "a second one ends the program";
    }
    EXPECT_EQ(handler_of(SIGINT), SIG_DFL);
    EXPECT_EQ(handler_of(SIGTERM), SIG_DFL);
    EXPECT_EQ(handler_of(SIGHUP), SIG_DFL);
  }
}

TEST(StopRequest, GoesOnWithoutItsTerminalWhereThatIsWanted) {
  ::signal(SIGHUP, SIG_IGN);  // as nohup does
  {
    const StopRequest stop;
    raise(SIGHUP);
    EXPECT_FALSE(stop.is_made());
  }  // it leaves the signal ignored, as it was
  ::signal(SIGHUP, SIG_DFL);
}

}  // namespace
}  // namespace instep
