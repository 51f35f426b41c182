#include <gtest/gtest.h>

#include "sim/simulated_camera.h"
#include "sim/station_layout.h"

namespace instep {
namespace {

using namespace std::chrono_literals;

/// A small camera over the bare platform, in a time of its own.
std::unique_ptr<SimulatedCamera> camera_with(const char* script, std::uint64_t seed = 1) {
  LayoutSettings layout;
  layout.width_px = 64;
  layout.height_px = 48;
  SimulatedCamera::Settings settings;
  settings.geometry = lay_out_station(layout).value().front();
  settings.pacing = Pacing::kAsFastAsPossible;
  settings.seed = seed;
  settings.faults = parse_fault_script(script).value().of_camera("front");
  const auto view = std::make_shared<const ExactView>(render_depth({}, settings.geometry));
  return std::make_unique<SimulatedCamera>(settings, view);
}

std::vector<DepthFrame> frames_of(SimulatedCamera& camera, int count) {
  std::vector<DepthFrame> frames;
  for (int i = 0; i < count; ++i) {
    auto frame = camera.next_frame(100ms);
    EXPECT_TRUE(frame) << frame.error().line();
    if (frame) frames.push_back(std::move(*frame));
  }
  return frames;
}

ErrorCode code_of(const auto& result) {
  EXPECT_FALSE(result);
  return result ? ErrorCode::kInternal : result.error().code;
}

TEST(CameraFaults, FrameNumberDecidesItsBytes) {
  const auto first = camera_with("");
  const auto second = camera_with("");
  const auto other = camera_with("", 2);
  ASSERT_TRUE(first->start() && second->start() && other->start());
  const auto frames = frames_of(*first, 5);
  EXPECT_NE(frames[0].raw, frames[1].raw);
  EXPECT_NE(frames[0].raw, frames_of(*other, 1)[0].raw);
  second->stop();
  ASSERT_TRUE(second->start());
  for (const DepthFrame& frame : frames_of(*second, 5)) {
    EXPECT_EQ(frame.raw, frames[frame.sequence].raw);
  }
}

TEST(CameraFaults, StallEndsAfterItsTime) {
  const auto camera = camera_with("camera front: stall after 5 frames for 2 s");
  ASSERT_TRUE(camera->start());
  frames_of(*camera, 5);
  int timeouts = 0;
  auto frame = camera->next_frame(500ms);
  for (; !frame && timeouts < 100; frame = camera->next_frame(500ms)) {
    ASSERT_EQ(frame.error().code, ErrorCode::kTimeout);
    ++timeouts;
  }
  ASSERT_TRUE(frame);
  EXPECT_EQ(timeouts, 4);
  EXPECT_EQ(frame->sequence, 5U);
}

TEST(CameraFaults, RestartDoesNotEndAStall) {
  const auto camera = camera_with("camera front: stall after 1 frames for 2 s");
  ASSERT_TRUE(camera->start());
  frames_of(*camera, 1);
  camera->stop();
  ASSERT_TRUE(camera->start());
  EXPECT_EQ(code_of(camera->next_frame(1500ms)), ErrorCode::kTimeout);
  EXPECT_TRUE(camera->next_frame(1s));
}

TEST(CameraFaults, StallWithoutEndNeverEnds) {
  const auto camera = camera_with("camera front: stall after 2 frames");
  ASSERT_TRUE(camera->start());
  frames_of(*camera, 2);
  EXPECT_EQ(code_of(camera->next_frame(std::chrono::hours(10))), ErrorCode::kTimeout);
}

TEST(CameraFaults, VanishedCameraComesBackWhenItsTimeIsUp) {
  const auto camera = camera_with("camera front: vanish after 3 frames, return after 1 s");
  ASSERT_TRUE(camera->start());
  frames_of(*camera, 3);
  EXPECT_EQ(code_of(camera->next_frame(1s)), ErrorCode::kDeviceGone);
  int refused = 0;
  auto started = camera->start();
  for (; !started && refused < 100; started = camera->start()) {
    ASSERT_EQ(started.error().code, ErrorCode::kDeviceGone);
    ++refused;
  }
  ASSERT_TRUE(started);
  EXPECT_EQ(refused, 10) << "each takes a tenth of a second";
  EXPECT_EQ(frames_of(*camera, 2)[0].sequence, 3U);
}

TEST(CameraFaults, CameraMayStayAway) {
  const auto camera = camera_with("camera front: vanish after 0 frames");
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(code_of(camera->start()), ErrorCode::kDeviceGone);
}

TEST(CameraFaults, NeverStartsRefusesEveryTime) {
  const auto camera = camera_with("camera all: never starts");
  EXPECT_EQ(code_of(camera->start()), ErrorCode::kDeviceGone);
  EXPECT_EQ(code_of(camera->start()), ErrorCode::kDeviceGone);
  EXPECT_EQ(code_of(camera->next_frame(10ms)), ErrorCode::kInvalidInput);
}

TEST(CameraFaults, NeverStreamsStartsAndStaysSilent) {
  const auto camera = camera_with("camera front: never streams");
  ASSERT_TRUE(camera->start());
  EXPECT_EQ(code_of(camera->next_frame(60s)), ErrorCode::kTimeout);
}

TEST(CameraFaults, BadFramesAreTheOnesNamed) {
  const auto camera = camera_with(
      "camera front: corrupt frames 2-3\n"
      "camera front: shorten frame 4\n"
      "camera front: zero frame 5\n");
  const auto clean_camera = camera_with("");
  ASSERT_TRUE(camera->start() && clean_camera->start());
  const auto frames = frames_of(*camera, 6);
  const auto clean = frames_of(*clean_camera, 6);
  const std::size_t pixels = 64 * 48;

  EXPECT_EQ(frames[0].raw, clean[0].raw);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(frames[i].status, FrameStatus::kCorrupt);
    EXPECT_EQ(frames[i].raw.size(), pixels);
    EXPECT_NE(frames[i].raw, clean[i].raw);
  }
  EXPECT_EQ(frames[3].status, FrameStatus::kGood) << "the frame does not say that it is short";
  EXPECT_LT(frames[3].raw.size(), pixels);
  EXPECT_GT(frames[3].raw.size(), 0U);
  EXPECT_EQ(frames[4].raw, std::vector<std::uint16_t>(pixels, 0));
  EXPECT_EQ(frames[4].status, FrameStatus::kGood);
  EXPECT_EQ(frames[5].raw, clean[5].raw);
}

}  // namespace
}  // namespace instep
