#include "config/capture_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

using namespace std::chrono_literals;

Settings station(int frames, int warmup, std::chrono::milliseconds deadline) {
  Settings settings;
  settings.cameras = {CameraSettings{}, CameraSettings{}, CameraSettings{}};
  for (auto& camera : settings.cameras) camera.kind = CameraKind::kRecording;
  settings.capture.frames_per_camera = frames;
  settings.capture.warmup_frames = warmup;
  settings.capture.deadline = deadline;
  return settings;
}

TEST(CaptureTime, IsToldWhereNoScanCanBeDoneInTime) {
  EXPECT_THAT(
      warning_of_short_deadline(station(120, 3, 200ms)),
      testing::HasSubstr("capture.deadline_ms = 200 is too short for a scan: 120 frames and "
                         "3 to warm up take 4100 ms at 30 frames a second"));
  EXPECT_EQ(warning_of_short_deadline(station(27, 3, 1000ms)), "");
  EXPECT_NE(warning_of_short_deadline(station(28, 3, 1000ms)), "");
  EXPECT_EQ(warning_of_short_deadline(Settings{}), "") << "the defaults";
}

TEST(CaptureTime, CountsCamerasThatAreReadInTurn) {
  auto in_turn = station(27, 3, 2999ms);
  EXPECT_EQ(warning_of_short_deadline(in_turn), "");
  in_turn.capture.one_at_a_time = true;
  EXPECT_THAT(warning_of_short_deadline(in_turn),
              testing::HasSubstr("take 3000 ms one camera after the other"));
  in_turn.capture.deadline = 3000ms;
  EXPECT_EQ(warning_of_short_deadline(in_turn), "");
}

TEST(CaptureTime, IsNoMatterOfASimulationThatLosesNone) {
  auto simulated = station(120, 3, 200ms);
  for (auto& camera : simulated.cameras) camera.kind = CameraKind::kSimulated;
  simulated.simulation.pacing = SimulatedPacing::kAsFastAsPossible;
  EXPECT_EQ(warning_of_short_deadline(simulated), "");
  simulated.simulation.pacing = SimulatedPacing::kRealTime;
  EXPECT_NE(warning_of_short_deadline(simulated), "");
}

}  // namespace
}  // namespace instep
