#include "core/foot/axis/foot_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/foot_body.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A foot of whose front a dozen points are left, too few for a border.
std::vector<Vector3d> without_a_front() {
  std::vector<Vector3d> points;
  std::size_t of_front = 0;
  for (const auto& point : test::FootBody{260.0, 5.0}.points().positions) {
    if (point.x() < 190.0 || of_front++ % 60 == 0) points.push_back(point);
  }
  return points;
}

TEST(FootAxis, WithoutToesIsThatOfTheOutlineAndSaysSo) {
  const auto points = without_a_front();
  const auto outline = find_outline_axis(points);
  ASSERT_TRUE(outline) << outline.error().line();
  const auto axis = find_foot_axis(points, *outline, Side::kRight);
  EXPECT_FALSE(axis.toe2_tip);
  EXPECT_FALSE(axis.is_second_toe_resolved);
  EXPECT_EQ(axis.rule, AxisRule::kOutline);
  EXPECT_GT(axis.acropodion.x(), 200.0);
}

TEST(FootAxis, ThatNeedsNoToesIsFoundWithoutThem) {
  const auto points = without_a_front();
  const auto outline = find_outline_axis(points);
  ASSERT_TRUE(outline) << outline.error().line();
  const auto axis = find_foot_axis(points, *outline, Side::kRight, AxisRule::kHeelCentre);
  EXPECT_EQ(axis.rule, AxisRule::kHeelCentre);
  const auto whole = test::FootBody{260.0, 5.0}.points().positions;
  const auto of_whole =
      find_foot_axis(whole, *find_outline_axis(whole), Side::kRight, AxisRule::kHeelCentre);
  const double turn = std::acos(
      (axis.foot_from_standing.linear() * of_whole.foot_from_standing.linear().transpose())(0, 0));
  EXPECT_LT(turn, 0.03);
}

}  // namespace
}  // namespace instep
