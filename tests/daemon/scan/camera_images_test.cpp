#include "daemon/scan/camera_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/simulated_scan.h"

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

TEST(CameraImages, AreNoneForAReasonThatIsTold) {
  auto torn = wall("right", 1400);
  torn.status = FrameStatus::kCorrupt;
  auto far = wall("right", 1400);  // as of a camera with a depth unit ten times too large
  far.depth_unit_mm = 5.0;
  for (const auto& [frame, reason, help] :
       {std::tuple{torn, "came damaged", "check its cable"},
        std::tuple{far, "nearly nothing from 50.0 mm to 3000.0 mm away", "depth_unit_mm"}}) {
    const auto images = camera_images(two_cameras({wall("left", 800), frame}), always);
    ASSERT_FALSE(images);
    EXPECT_THAT(images.error().message, testing::HasSubstr(reason));
    EXPECT_THAT(images.error().advice, testing::HasSubstr(help));
  }
}

TEST(CameraImages, WarnOfACameraWhoseFramesAreMostlyOfNoUse) {
  auto torn = wall("right", 1400);
  torn.status = FrameStatus::kCorrupt;
  auto frames = std::vector{wall("left", 800), wall("right", 1400), torn};
  EXPECT_TRUE(rejection_warnings(*camera_images(two_cameras(frames), always)).empty());
  frames.push_back(torn);
  const auto of_right = testing::HasSubstr("2 of 3 frames of camera right were of no use");
  EXPECT_THAT(rejection_warnings(*camera_images(two_cameras(frames), always)),
              testing::ElementsAre(of_right));
  const auto measured = measure_capture(two_cameras(frames), {}, {});
  ASSERT_FALSE(measured) << "walls are no feet";
  EXPECT_THAT(measured.error().line(), of_right);
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

/// Skin seen from the side is noisiest: a foot that stood still was said to have moved by 1.5 mm.
TEST(CameraImages, OfAFootThatStandsStillBeforeNoisyCamerasTellOfNoMovement) {
  SimulationSettings settings;
  settings.noise = NoiseLaw::kPessimistic;
  auto scan = test::scan_of(settings);
  ASSERT_TRUE(scan) << scan.error().line();
  const auto images = camera_images(scan->capture, always);
  ASSERT_TRUE(images) << images.error().line();
  for (const auto& image : *images) EXPECT_FALSE(image.moved) << image.movement_mm;
}

}  // namespace
}  // namespace instep
