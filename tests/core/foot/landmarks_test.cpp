#include "core/foot/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/foot/alignment.h"
#include "core/geometry/extent.h"
#include "tests/support/foot_body.h"

namespace instep {
namespace {

using test::FootBody;

/// Extent of the body itself, by a very dense cloud, along the axis that was found.
double dense_length(const FootScan& foot) {
  const auto dense = transformed(foot.foot_from_input, FootBody{260.0, 0.35}.points());
  return extent_along<Eigen::Vector3d>(dense.positions, Eigen::Vector3d::UnitX()).length();
}

TEST(Landmarks, StandWhereTheBodyProtrudes) {
  const auto found = align_foot(FootBody{}.points()).and_then(find_landmarks);
  ASSERT_TRUE(found) << found.error().line();
  const FootScan& foot = *found;
  const auto at = [&](const char* name) { return foot.landmarks.at(name).position_mm; };
  // The body's own borders are known along its own axis, some degrees from the foot's.
  EXPECT_NEAR(at("metatarsale_tibiale").x(), 0.70 * 260.0, 8.0);
  EXPECT_NEAR(at("metatarsale_fibulare").x(), 0.62 * 260.0, 8.0);
  EXPECT_GT(at("metatarsale_tibiale").y(), 30.0);
  EXPECT_LT(at("metatarsale_fibulare").y(), -30.0);
  EXPECT_NEAR(at("instep_point").x(), dense_length(foot) / 2.0, 0.2);
  EXPECT_NEAR(at("instep_point").z(), FootBody{}.height(130.0), 2.0);
  for (const auto& [name, landmark] : foot.landmarks) {
    EXPECT_GT(landmark.confidence, 0.0) << name;
    EXPECT_LE(landmark.confidence, 1.0) << name;
    EXPECT_FALSE(landmark.rule.empty()) << name;
  }
}

TEST(Landmarks, FallBackToTheAverageFootWhereTheBorderIsStraight) {
  auto cloud = FootBody{}.points();
  const auto foot = align_foot(cloud);
  ASSERT_TRUE(foot);
  auto straight = *foot;
  for (auto& point : straight.cloud.positions) {
    if (point.x() > 100.0 && point.x() < 240.0 && point.y() < 0.0) {
      point.y() = std::max(point.y(), -25.0);
    }
  }
  const auto found = find_landmarks(straight);
  ASSERT_TRUE(found);
  const auto& fibulare = found->landmarks.at("metatarsale_fibulare");
  EXPECT_LT(fibulare.confidence, 0.35);
  EXPECT_NEAR(fibulare.position_mm.x(), 0.63 * 260.0, 2.0);
  EXPECT_FALSE(found->warnings.empty());
}

/// The furthest point of what is left of the border is the hole's edge: no end of a breadth.
TEST(Landmarks, OfABorderAreNotAtTheEdgesOfAHole) {
  auto foot = align_foot(FootBody{}.points());
  ASSERT_TRUE(foot) << foot.error().line();
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < foot->cloud.size(); ++i) {
    const auto& point = foot->cloud.positions[i];
    const bool is_gone = point.x() > 0.58 * 260.0 && point.x() < 0.82 * 260.0 && point.z() < 30.0;
    if (!is_gone) left.push_back(i);
  }
  foot->cloud = foot->cloud.subset(left);
  const auto found = find_landmarks(*foot);
  ASSERT_TRUE(found) << found.error().line();
  EXPECT_FALSE(found->landmarks.contains("metatarsale_tibiale"));
  EXPECT_FALSE(found->landmarks.contains("ball_medial"));
}

TEST(Landmarks, AreNotSoughtOnAFootThatIsNotAligned) {
  const auto found = find_landmarks(FootScan{});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInvalidInput);
}

TEST(Landmarks, TellOfEachRedrawAndEndWhenTheyAreNoLongerWanted) {
  const auto foot = align_foot(FootBody{}.points()).value();
  int told = 0;
  ASSERT_TRUE(find_landmarks_by(one_after_the_other, foot, [&] { return ++told > 0; }));
  EXPECT_GE(told, 10);
  int asked = 0;
  const auto ended = find_landmarks_by(one_after_the_other, foot, [&] { return ++asked < 3; });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace instep
