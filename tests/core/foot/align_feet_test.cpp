#include "core/foot/align_feet.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Two feet side by side, their toes on +x: of a person who looks that way, the left one has the
/// greater y.
constexpr double kBesideMm = 75.0;

PointCloud at(PointCloud cloud, double y, double turn = 0.0) {
  RigidTransform move(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  move.pretranslate(Vector3d(0.0, y, 0.0));
  return transformed(move, cloud);
}

PointCloud right_foot() {
  return test::FootBody{}.points();
}
PointCloud left_foot() {
  return test::mirrored(test::FootBody{}.points());
}

bool says(const FootScan& foot, const std::string& words) {
  for (const auto& warning : foot.warnings) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

AlignmentOptions on_the_floor() {
  AlignmentOptions options;
  options.standing_plane = StandingPlane{};
  return options;
}

TEST(AlignFeet, ReturnsTheLeftOneFirst) {
  const std::vector<PointCloud> both{at(right_foot(), -kBesideMm), at(left_foot(), kBesideMm)};
  for (const bool are_swapped : {false, true}) {
    const auto feet =
        align_feet(are_swapped ? std::vector{both[1], both[0]} : both, on_the_floor());
    ASSERT_TRUE(feet) << feet.error().line();
    ASSERT_EQ(feet->size(), 2U);
    EXPECT_EQ((*feet)[0].side, Side::kLeft);
    EXPECT_EQ((*feet)[1].side, Side::kRight);
    for (const auto& foot : *feet) {
      EXPECT_GE(foot.side_confidence, 0.98);
      EXPECT_LT(foot.side_confidence, 1.0);
      EXPECT_FALSE(says(foot, "crossed"));
    }
  }
}

/// A side that was forced is for a foot alone.
TEST(AlignFeet, TellsTwoFeetBySideWhateverSideIsForced) {
  auto options = on_the_floor();
  options.side = Side::kRight;
  const auto feet = align_feet({at(right_foot(), -kBesideMm), at(left_foot(), kBesideMm)}, options);
  ASSERT_TRUE(feet) << feet.error().line();
  EXPECT_EQ(feet->front().side, Side::kLeft);
  const auto alone = align_feet({left_foot()}, options);
  ASSERT_TRUE(alone) << alone.error().line();
  EXPECT_EQ(alone->front().side, Side::kRight);
}

TEST(AlignFeet, GoesByThePlaceOfCrossedFeetAndSaysSo) {
  const auto feet =
      align_feet({at(left_foot(), -kBesideMm), at(right_foot(), kBesideMm)}, on_the_floor());
  ASSERT_TRUE(feet) << feet.error().line();
  ASSERT_EQ(feet->size(), 2U);
  EXPECT_EQ((*feet)[0].side, Side::kLeft);
  EXPECT_EQ((*feet)[1].side, Side::kRight);
  for (const auto& foot : *feet) {
    EXPECT_TRUE(says(foot, "not crossed"));
    EXPECT_FALSE(says(foot, "asked for"));
    EXPECT_FALSE(foot.is_side_sure()) << "its shape is clearly the other's";
  }
  EXPECT_EQ((*feet)[0].cloud_number, 1U);
  EXPECT_EQ((*feet)[1].cloud_number, 0U);
}

TEST(AlignFeet, KeepsTheShapesOfFeetThatPointDifferentWays) {
  const auto feet =
      align_feet({at(right_foot(), -kBesideMm), at(right_foot(), kBesideMm, 3.0)}, on_the_floor());
  ASSERT_TRUE(feet) << feet.error().line();
  ASSERT_EQ(feet->size(), 2U);
  for (const auto& foot : *feet) {
    EXPECT_EQ(foot.side, Side::kRight);
    EXPECT_TRUE(says(foot, "same side"));
    EXPECT_FALSE(foot.is_side_sure()) << "one of them is a left one";
  }
}

/// One behind the other neither stands on the left.
TEST(AlignFeet, KeepsTheShapesOfFeetOneBehindTheOther) {
  PointCloud behind = at(left_foot(), -3.0);
  for (auto& point : behind.positions) point.x() -= 330.0;
  // Before one that points aside by 30 degrees, the other stands on its left if seen along it.
  for (const double turn : {0.0, 0.5}) {
    const std::vector<PointCloud> both{at(right_foot(), 0.0, turn), behind};
    for (const bool are_swapped : {false, true}) {
      const auto feet =
          align_feet(are_swapped ? std::vector{both[1], both[0]} : both, on_the_floor());
      ASSERT_TRUE(feet) << feet.error().line();
      ASSERT_EQ(feet->size(), 2U);
      EXPECT_EQ((*feet)[0].cloud_number, are_swapped ? 0U : 1U) << "the left one";
      for (const auto& foot : *feet) EXPECT_FALSE(says(foot, "crossed"));
    }
  }
}

/// A box of 100 x 60 x 40 mm: as long as what may be a foot, but none.
PointCloud box() {
  PointCloud cloud;
  for (double x = 0.0; x <= 100.0; x += 2.0) {
    for (double y = 0.0; y <= 60.0; y += 2.0) cloud.positions.emplace_back(x, y, 40.0);
    for (double z = 0.0; z <= 40.0; z += 2.0) {
      cloud.positions.emplace_back(x, 0.0, z);
      cloud.positions.emplace_back(x, 60.0, z);
    }
  }
  return cloud;
}

std::string why_not(const std::vector<PointCloud>& clouds) {
  const auto feet = align_feet(clouds, on_the_floor());
  return feet ? "measured" : feet.error().message;
}

TEST(AlignFeet, FailsForWhatIsNoFoot) {
  EXPECT_NE(why_not({right_foot(), at(box(), 120.0)}).find("not a foot"), std::string::npos);
  EXPECT_TRUE(align_feet({})->empty());
}

/// A person looks along +x, and along -x once all is turned.
TEST(AlignFeet, SaysWhichOfTwoFailsByWhereItStands) {
  const std::vector<PointCloud> there{right_foot(), at(box(), 120.0)};
  EXPECT_EQ(why_not(there).find("the left one of two feet: "), 0U);
  EXPECT_EQ(why_not({there[1], there[0]}).find("the left one of two feet: "), 0U);
  EXPECT_EQ(why_not({left_foot(), at(box(), -180.0)}).find("the right one of two feet: "), 0U);
  const double half_turn = std::acos(-1.0);
  EXPECT_EQ(
      why_not({at(there[0], 0.0, half_turn), at(there[1], 0.0, half_turn)}).find("the left one"),
      0U);
}

TEST(AlignFeet, SaysOfTwoThatBothFail) {
  EXPECT_EQ(why_not({box(), at(box(), 120.0)}).find("both feet: "), 0U);
  PointCloud few;
  few.positions.assign(3, Vector3d::Zero());
  const std::string both = why_not({box(), few});
  EXPECT_NE(both.find("not a foot"), std::string::npos);
  EXPECT_NE(both.find("points"), std::string::npos);
}

TEST(AlignFeet, EndsAfterTheFootAtWhichItIsNoLongerWanted) {
  int asked = 0;
  const auto cloud = test::FootBody{}.points();
  const auto ended = align_feet({cloud, cloud}, {}, [&] { return ++asked < 1; });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace instep
