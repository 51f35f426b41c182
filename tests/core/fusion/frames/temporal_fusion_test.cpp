#include "core/fusion/frames/temporal_fusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/fused_frames.h"
#include "tests/support/ray_cast_scene.h"

namespace instep {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr std::size_t kPixels = kWidth * kHeight;

DepthFrame flat_frame(std::uint16_t raw, double unit_mm = 1.0) {
  DepthFrame frame;
  frame.camera = "cam";
  frame.width = kWidth;
  frame.height = kHeight;
  frame.depth_unit_mm = unit_mm;
  frame.raw.assign(kPixels, raw);
  return frame;
}

CameraGeometry small_camera() {
  return camera_looking_at("cam", {0, 0, 500}, {0, 0, 0}, kWidth, kHeight, 150);
}

/// A wall across the line of sight, 500 mm away.
Surfaces wall() {
  return {disc_surface({0, 0, 0}, {0, 0, 1}, 1000)};
}

std::vector<DepthFrame> noisy_wall(int count, double axial_per_mm, double unit_mm) {
  std::vector<DepthFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(render(small_camera(), wall(), {axial_per_mm, 0, 0},
                            static_cast<std::uint64_t>(i) + 1, unit_mm));
  }
  return frames;
}

double sd_of_z(const FusedDepth& fused, double truth_mm) {
  double sum = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    sum += std::pow((fused.depth_mm[i] - truth_mm) / fused.sigma_mm[i], 2);
  }
  return std::sqrt(sum / kPixels);
}

TEST(TemporalFusion, KeepsASigmaThatIsTrueForOneFrameAndForMany) {
  for (const int count : {1, 2, 5, 15, 30}) {
    const auto fused = fuse_frames(noisy_wall(count, 2.9e-6, 1.0));
    ASSERT_TRUE(fused);
    const double sd = sd_of_z(*fused, 500.0);
    EXPECT_GT(sd, 0.7) << count;
    EXPECT_LT(sd, 1.4) << count;
  }
}

TEST(TemporalFusion, LearnsTheNoiseOfACameraThatIsBetterOrWorseThanItsModel) {
  for (const double axial : {1.4e-6, 6e-6}) {
    const auto fused = fuse_frames(noisy_wall(15, axial, 0.1));
    ASSERT_TRUE(fused);
    const double sd = sd_of_z(*fused, 500.0);
    EXPECT_GT(sd, 0.7) << axial;
    EXPECT_LT(sd, 1.4) << axial;
  }
}

TEST(TemporalFusion, GetsBetterWithFramesButNotBetterThanTheRounding) {
  const auto one = fuse_frames(noisy_wall(1, 2.9e-6, 1.0));
  const auto many = fuse_frames(noisy_wall(15, 2.9e-6, 1.0));
  ASSERT_TRUE(one && many);
  EXPECT_LT(many->sigma_mm[500], 0.45 * one->sigma_mm[500]);
  // Without noise every frame says the same: 500.4 mm is told as 500 for ever.
  auto settings = TemporalSettings{};
  settings.noise.axial_per_mm = 1e-8;
  const std::vector<DepthFrame> same(30, flat_frame(500));
  const auto frozen = fuse_frames(same, settings);
  ASSERT_TRUE(frozen);
  EXPECT_GT(frozen->sigma_mm[500], 0.25);
}

TEST(TemporalFusion, IsNotPulledByAFewWildValues) {
  auto frames = noisy_wall(15, 1.4e-6, 0.1);
  for (std::size_t i = 0; i < kPixels; ++i) {
    frames[1].raw[i] = 9000;
    frames[7].raw[i] = 700;
    frames[9].raw[i] = 0;
  }
  const auto fused = fuse_frames(frames);
  ASSERT_TRUE(fused);
  for (std::size_t i = 0; i < kPixels; ++i) ASSERT_NEAR(fused->depth_mm[i], 500.0, 0.7);
}

TEST(TemporalFusion, DropsPixelsSeenInTooFewFramesAndOutOfRange) {
  auto frames = noisy_wall(10, 1.4e-6, 1.0);
  for (std::size_t i = 0; i < 7; ++i) frames[i].raw[33] = 0;
  for (std::size_t i = 0; i < 5; ++i) frames[i].raw[34] = 0;
  for (auto& frame : frames) {
    frame.raw[35] = 65535;
    frame.raw[36] = 4000;
    frame.raw[37] = 20;
  }
  const auto fused = fuse_frames(frames);
  ASSERT_TRUE(fused);
  for (const std::size_t pixel : {33U, 35U, 36U, 37U}) {
    EXPECT_EQ(fused->depth_mm[pixel], 0.0F);
    EXPECT_EQ(fused->sigma_mm[pixel], 0.0F);
  }
  EXPECT_NEAR(fused->depth_mm[34], 500.0, 2.0);
}

TEST(TemporalFusion, CountsAndRefusesBadFrames) {
  TemporalFusion fusion;
  auto damaged = flat_frame(500);
  damaged.status = FrameStatus::kCorrupt;
  auto cut = flat_frame(500);
  cut.raw.pop_back();
  auto negative = flat_frame(500);
  negative.width = -negative.width;
  negative.height = -negative.height;
  auto no_unit = flat_frame(500);
  no_unit.depth_unit_mm = std::nan("");
  for (const auto& frame : {damaged, cut, negative, no_unit}) {
    const auto added = fusion.add(frame);
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kCorruptData);
  }
  for (const std::uint16_t raw : {std::uint16_t{0}, std::uint16_t{65535}}) {
    const auto added = fusion.add(flat_frame(raw));
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kInsufficientData);
  }
  EXPECT_FALSE(fusion.result());
  EXPECT_TRUE(fusion.add(flat_frame(500)));
  EXPECT_FALSE(fusion.add(flat_frame(500, 0.1)));
  auto turned = flat_frame(500);
  std::swap(turned.width, turned.height);
  EXPECT_FALSE(fusion.add(turned));
  const auto fused = fusion.result();
  ASSERT_TRUE(fused);
  EXPECT_EQ(fused->frames_used, 1);
  EXPECT_EQ(fused->frames_rejected, 8);
  EXPECT_EQ(fused->camera, "cam");
}

TEST(TemporalFusion, UsesAllFramesThatAStationMayTakeAndCallsNoneBeyondBad) {
  for (const int expected_frames : {-1, 0, 4, 15, 120, 1000}) {
    TemporalSettings settings;
    settings.expected_frames = expected_frames;
    TemporalFusion fusion(settings);
    for (int i = 0; i < 130; ++i) {
      EXPECT_TRUE(fusion.add(flat_frame(static_cast<std::uint16_t>(i % 2 == 0 ? 499 : 501))));
    }
    EXPECT_EQ(fusion.frames_used(), 120) << "capture.frames_per_camera may be as many";
    EXPECT_EQ(fusion.frames_rejected(), 0);
    EXPECT_NEAR(fusion.result()->depth_mm[30], 500.0, 1e-3);
  }
}

/// A foot on the floor of which each frame sees this much more of x.
FusedDepth foot_that_moves(double by_mm, double axial_per_mm) {
  TemporalFusion fusion;
  for (int i = 0; i < 10; ++i) {
    const Surfaces scene = {disc_surface({0, 0, 0}, {0, 0, 1}, 1000),
                            ellipsoid_surface({by_mm * i, 0, 10}, {125, 45, 60})};
    EXPECT_TRUE(fusion.add(
        render(small_camera(), scene, {axial_per_mm, 0, 0}, static_cast<std::uint64_t>(i) + 1)));
  }
  return fusion.result().value();
}

TEST(TemporalFusion, NoticesAFootThatMoves) {
  EXPECT_FALSE(foot_that_moves(0.0, 2.9e-6).moved);
  EXPECT_TRUE(foot_that_moves(0.8, 2.9e-6).moved);
}

/// Four times as noisy as its model: a foot that stood still was said to have moved by 1.4 mm.
TEST(TemporalFusion, TakesNoiseOfACameraThatIsWorseThanItsModelForNoMovement) {
  const FusedDepth still = foot_that_moves(0.0, 1.2e-5);
  EXPECT_FALSE(still.moved) << still.movement_mm;
  const FusedDepth moving = foot_that_moves(1.5, 1.2e-5);
  EXPECT_TRUE(moving.moved) << moving.movement_mm;
}

TEST(TemporalFusion, DoesNotDependOnTheOrderOfFrames) {
  auto frames = noisy_wall(9, 2.9e-6, 1.0);
  const auto there = fuse_frames(frames);
  std::reverse(frames.begin(), frames.end());
  const auto back = fuse_frames(frames);
  ASSERT_TRUE(there && back);
  EXPECT_EQ(there->depth_mm, back->depth_mm);
  EXPECT_EQ(there->sigma_mm, back->sigma_mm);
}

}  // namespace
}  // namespace instep
