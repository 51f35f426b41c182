#include "core/fusion/frames/lens.h"

#include <gtest/gtest.h>

#include <limits>

namespace instep {
namespace {

using Eigen::Vector2i;

/// Sees a millimetre a pixel at 100 mm; the axis meets its image between four pixels.
const CameraIntrinsics kLens{40, 30, 100.0, 100.0, 19.5, 14.5};

TEST(PixelSeeing, IsTheOneInWhichThePointLies) {
  EXPECT_EQ(pixel_seeing(kLens, {0.4, -0.4, 100.0}), Vector2i(20, 14));
  EXPECT_EQ(pixel_seeing(kLens, {-0.6, 0.6, 100.0}), Vector2i(19, 15));
  EXPECT_EQ(pixel_seeing(kLens, {-1.2, 1.2, 200.0}), Vector2i(19, 15));
}

TEST(PixelSeeing, ReachesToTheEdgesOfTheImage) {
  EXPECT_EQ(pixel_seeing(kLens, {-19.9, -14.9, 100.0}), Vector2i(0, 0));
  EXPECT_EQ(pixel_seeing(kLens, {19.9, 14.9, 100.0}), Vector2i(39, 29));
  EXPECT_FALSE(pixel_seeing(kLens, {-20.1, 0.0, 100.0}));
  EXPECT_FALSE(pixel_seeing(kLens, {20.1, 0.0, 100.0}));
  EXPECT_FALSE(pixel_seeing(kLens, {0.0, -15.1, 100.0}));
  EXPECT_FALSE(pixel_seeing(kLens, {0.0, 15.1, 100.0}));
}

TEST(PixelSeeing, IsNoneBehindTheCameraOrOfNoPlace) {
  EXPECT_FALSE(pixel_seeing(kLens, {0.0, 0.0, -100.0}));
  EXPECT_FALSE(pixel_seeing(kLens, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(pixel_seeing(kLens, {std::numeric_limits<double>::quiet_NaN(), 0.0, 100.0}));
}

}  // namespace
}  // namespace instep
