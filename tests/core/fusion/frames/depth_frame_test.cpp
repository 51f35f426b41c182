#include "core/fusion/frames/depth_frame.h"

#include <gtest/gtest.h>

#include <limits>

namespace instep {
namespace {

CameraIntrinsics good_lens() {
  CameraIntrinsics lens;
  lens.width = 640;
  lens.height = 480;
  lens.fx = lens.fy = 575.8;
  lens.cx = 319.5;
  lens.cy = 239.5;
  return lens;
}

const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CheckIntrinsics, TakesWhatRealCamerasHave) {
  EXPECT_TRUE(check_intrinsics(good_lens()));
  auto distorted = good_lens();
  distorted.distortion = {-0.28, 0.09, 0.001, -0.0007, -0.01};
  EXPECT_TRUE(check_intrinsics(distorted));
  auto wide = good_lens();
  wide.fx = wide.fy = 382;
  wide.distortion = {0.12, -0.2, 0.002, 0.001, 0.08};
  EXPECT_TRUE(check_intrinsics(wide));
}

TEST(CheckIntrinsics, RefusesSizesThatNoCameraHas) {
  for (const int side : {-5, 0, 15, 8193, std::numeric_limits<int>::max()}) {
    auto lens = good_lens();
    lens.width = side;
    EXPECT_EQ(check_intrinsics(lens).error().code, ErrorCode::kInvalidInput);
    lens = good_lens();
    lens.height = side;
    EXPECT_FALSE(check_intrinsics(lens));
  }
}

TEST(CheckIntrinsics, RefusesFocalLengthsAndCentresThatNoCameraHas) {
  for (const double value : {kNan, 1e30, -1e30, std::numeric_limits<double>::infinity()}) {
    for (double CameraIntrinsics::*member : {&CameraIntrinsics::fx, &CameraIntrinsics::fy,
                                             &CameraIntrinsics::cx, &CameraIntrinsics::cy}) {
      auto lens = good_lens();
      lens.*member = value;
      EXPECT_FALSE(check_intrinsics(lens)) << value;
    }
  }
  auto lens = good_lens();
  lens.fx = 60;
  EXPECT_FALSE(check_intrinsics(lens));
  lens = good_lens();
  lens.cy = -490;
  EXPECT_FALSE(check_intrinsics(lens));
}

TEST(CheckIntrinsics, RefusesDistortionThatFoldsTheImage) {
  for (std::size_t i = 0; i < 5; ++i) {
    for (const double value : {kNan, 1e30, -1e30}) {
      auto lens = good_lens();
      lens.distortion[i] = value;
      EXPECT_FALSE(check_intrinsics(lens)) << i << " " << value;
    }
  }
  // x (1 - 1.5 r^2) turns back at r = 0.47, where it is 0.31; the corner of the image is at 0.69.
  auto lens = good_lens();
  lens.distortion[0] = -1.5;
  const auto checked = check_intrinsics(lens);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("folds"), std::string::npos);
}

}  // namespace
}  // namespace instep
