#include "daemon/scan/camera_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

namespace instep {
namespace {

constexpr int kSide_px = 20;

CameraDescription camera(const std::string& id) {
  CameraDescription camera;
  camera.geometry.id = id;
  camera.geometry.intrinsics = {kSide_px, kSide_px, 20.0, 20.0, 9.5, 9.5};
  camera.geometry.station_from_camera.translation().z() = id == "left" ? 400.0 : 700.0;
  return camera;
}

/// A wall at one depth, of a camera whose unit of depth is half a millimetre.
DepthFrame wall(const std::string& id, std::uint16_t raw) {
  DepthFrame frame;
  frame.camera = id;
  frame.width = frame.height = kSide_px;
  frame.depth_unit_mm = 0.5;
  frame.raw.assign(kSide_px * kSide_px, raw);
  return frame;
}

Capture two_cameras(std::vector<DepthFrame> frames) {
  Capture capture;
  capture.cameras = {camera("left"), camera("right")};
  capture.frames = std::move(frames);
  return capture;
}

TEST(CameraImages, AreOfEachCameraInTheirOrderWhateverThatOfTheFrames) {
  auto torn = wall("right", 1400);
  torn.status = FrameStatus::kCorrupt;
  const auto capture = two_cameras({wall("right", 1400), wall("left", 800), torn, wall("left", 800),
                                    wall("right", 1400), wall("left", 800)});
  auto images = camera_images(capture, always);
  ASSERT_TRUE(images) << images.error().line();
  ASSERT_EQ(images->size(), 2U);
  const auto middle = static_cast<std::size_t>(kSide_px * kSide_px / 2 + kSide_px / 2);
  EXPECT_NEAR((*images)[0].depth_mm[middle], 400.0, 0.01);
  EXPECT_EQ((*images)[0].frames_used, 3);
  EXPECT_EQ((*images)[0].frames_rejected, 0);
  EXPECT_NEAR((*images)[1].depth_mm[middle], 700.0, 0.01);
  EXPECT_EQ((*images)[1].frames_used, 2);
  EXPECT_EQ((*images)[1].frames_rejected, 1);

  const auto views = views_of(capture, std::move(*images));
  ASSERT_EQ(views.size(), 2U);
  for (const auto& view : views) {
    // Each camera stands as high as its wall is far.
    EXPECT_EQ(view.geometry.id, view.depth.camera);
    EXPECT_NEAR(view.geometry.station_from_camera.translation().z(), view.depth.depth_mm[middle],
                0.01);
  }
}

TEST(CameraImages, AreNoneWhereACameraGaveNothingOfUse) {
  auto torn = wall("right", 1400);
  torn.status = FrameStatus::kIncomplete;
  for (const auto& frames :
       {std::vector{wall("left", 800)}, std::vector{wall("left", 800), torn}}) {
    const auto images = camera_images(two_cameras(frames), always);
    ASSERT_FALSE(images);
    EXPECT_EQ(images.error().code, ErrorCode::kInsufficientData);
    EXPECT_THAT(images.error().message, testing::HasSubstr("camera right"));
  }
}

TEST(CameraImages, AreGivenUpWhenNobodyWantsThem) {
  std::atomic<int> asked = 0;
  const auto images =
      camera_images(two_cameras({wall("left", 800), wall("right", 1400), wall("left", 800)}), [&] {
        ++asked;
        return false;
      });
  ASSERT_FALSE(images);
  EXPECT_EQ(images.error().code, ErrorCode::kCancelled);
  EXPECT_LE(asked, 2) << "once for each camera";
}

}  // namespace
}  // namespace instep
