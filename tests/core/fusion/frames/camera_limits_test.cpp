#include "core/fusion/frames/camera_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fusion/frames/temporal_fusion.h"

namespace instep {
namespace {

TEST(CameraLimits, HoldOfTheDepthUnit) {
  EXPECT_TRUE(is_depth_unit(kSmallestDepthUnitMm));
  EXPECT_TRUE(is_depth_unit(kLargestDepthUnitMm));
  for (const double none : {0.0, -1.0, 0.5 * kSmallestDepthUnitMm, 2.0 * kLargestDepthUnitMm,
                            std::nan(""), double{INFINITY}}) {
    EXPECT_FALSE(is_depth_unit(none)) << none;
  }
}

TEST(CameraLimits, HoldOfThePose) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  EXPECT_FALSE(fault_of_pose(pose));
  pose(1, 3) = -kFarthestCameraMm;
  EXPECT_FALSE(fault_of_pose(pose));
  pose(1, 3) *= 1.01;
  EXPECT_NE(fault_of_pose(pose).value_or("").find("more than 100 m away"), std::string::npos);
  pose(3, 3) = 2.0;
  EXPECT_NE(fault_of_pose(pose).value_or("").find("no rotation and shift"), std::string::npos);
  pose(3, 3) = std::nan("");
  EXPECT_TRUE(fault_of_pose(pose));
}

// Frames were refused, as of a bad cable, whose camera had been taken.
TEST(CameraLimits, AreThoseOfTheFrames) {
  for (const double unit_mm : {kSmallestDepthUnitMm, kLargestDepthUnitMm}) {
    DepthFrame frame;
    frame.camera = "left";
    frame.width = kSmallestImageSide;
    frame.height = kSmallestImageSide;
    frame.depth_unit_mm = unit_mm;
    frame.raw.assign(kSmallestImageSide * kSmallestImageSide, 5);
    const auto code = [&] {
      const auto added = TemporalFusion().add(frame);
      return added ? std::optional<ErrorCode>() : added.error().code;
    };
    EXPECT_NE(code(), ErrorCode::kCorruptData) << unit_mm;
    frame.depth_unit_mm = unit_mm < 1.0 ? 0.99 * unit_mm : 1.01 * unit_mm;
    EXPECT_EQ(code(), ErrorCode::kCorruptData) << unit_mm;
  }
}

}  // namespace
}  // namespace instep
