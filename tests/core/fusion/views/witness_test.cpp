#include "core/fusion/views/witness.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr int kSide_px = 41;
constexpr double kMargin_mm = 4.0;

/// A camera 500 mm above the origin that looks straight down, with 1 mm a pixel at 100 mm, and what
/// it sees: a floor at 100 mm of height, which fills its image. Its middle pixel is over the
/// origin.
class Lookout {
 public:
  Lookout() : lens_{kSide_px, kSide_px, 100.0, 100.0, 20.0, 20.0} {
    depth_.width = depth_.height = kSide_px;
    depth_.depth_mm.assign(kSide_px * kSide_px, 400.0F);
  }

  void see(int u, int v, float depth_mm) {
    depth_.depth_mm[static_cast<std::size_t>(v * kSide_px + u)] = depth_mm;
  }
  Verdict judge(double x, double y, double z) const {
    RigidTransform pose = RigidTransform::Identity();
    pose.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    pose.translation() << 0, 0, 500;
    return Witness({&lens_, &depth_, pose}).judge({x, y, z}, kMargin_mm);
  }

 private:
  CameraIntrinsics lens_;
  FusedDepth depth_;
};

TEST(Witness, ConfirmsWhatItSeesAndSeesThroughWhatIsInFrontOfIt) {
  const Lookout lookout;
  EXPECT_EQ(lookout.judge(0, 0, 100), Verdict::kConfirms);
  EXPECT_EQ(lookout.judge(0, 0, 103.9), Verdict::kConfirms);
  EXPECT_EQ(lookout.judge(0, 0, 96.1), Verdict::kConfirms);
  EXPECT_EQ(lookout.judge(0, 0, 104.1), Verdict::kSeesThrough);
  EXPECT_EQ(lookout.judge(10, -10, 300), Verdict::kSeesThrough);
  EXPECT_EQ(lookout.judge(0, 0, 95.9), Verdict::kNone) << "hidden by the floor";
}

TEST(Witness, KnowsNothingOfWhatItDoesNotLookAt) {
  const Lookout lookout;
  // At half its distance the image reaches 40 mm to each side, the last row of pixels left out.
  EXPECT_EQ(lookout.judge(38, 0, 300), Verdict::kSeesThrough);
  EXPECT_EQ(lookout.judge(40, 0, 300), Verdict::kNone);
  EXPECT_EQ(lookout.judge(0, -38, 300), Verdict::kSeesThrough);
  EXPECT_EQ(lookout.judge(0, -40, 300), Verdict::kNone);
  EXPECT_EQ(lookout.judge(0, 0, 600), Verdict::kNone) << "behind it";
  EXPECT_EQ(lookout.judge(0, 0, 500), Verdict::kNone) << "in its lens";
}

TEST(Witness, TakesTheNearestOfNinePixelsAndDoubtsAHole) {
  Lookout lookout;
  lookout.see(21, 21, 300.0F);  // beside the middle, at 200 mm of height
  EXPECT_EQ(lookout.judge(0, 0, 200), Verdict::kConfirms);
  EXPECT_EQ(lookout.judge(0, 0, 150), Verdict::kNone) << "perhaps behind that";
  EXPECT_EQ(lookout.judge(0, 0, 100), Verdict::kConfirms) << "the others show it";
  EXPECT_EQ(lookout.judge(-6, 6, 200), Verdict::kSeesThrough) << "two pixels on";
  lookout.see(21, 21, 0.0F);
  EXPECT_EQ(lookout.judge(0, 0, 200), Verdict::kNone);
  EXPECT_EQ(lookout.judge(0, 0, 100), Verdict::kConfirms);
}

}  // namespace
}  // namespace instep
