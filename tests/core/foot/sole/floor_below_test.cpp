#include "core/foot/sole/floor_below.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/foot/alignment.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kEdgeMm = 11.0;

/// Upright walls round a ground shaped as a stadium, with an edge in an arc of kEdgeMm below, of
/// which nothing lower than `cut_mm` was seen: as an aligned foot, which stands on its lowest
/// points.
FootScan walls(double cut_mm, double length_mm) {
  const double size = length_mm / 260.0;
  const double half_breadth = 45.0;
  const double straight = 260.0 - 2.0 * half_breadth;
  test::RandomNumbers random(7);
  FootScan foot;
  for (int i = 0; i < 40000; ++i) {
    const double height = random.uniform(cut_mm, 70.0);
    const double below = std::max(0.0, kEdgeMm - height);
    const double in = kEdgeMm - std::sqrt(kEdgeMm * kEdgeMm - below * below);
    const double along = random.uniform(0.0, straight + std::numbers::pi * half_breadth);
    const double side = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    Vector3d place(half_breadth + along, half_breadth - in, height);
    if (along > straight) {
      const double turn = (along - straight) / half_breadth - 0.5 * std::numbers::pi;
      const double end = turn > 0.0 ? half_breadth + straight : half_breadth;
      const Vector3d out(std::sin(turn), std::cos(turn), 0.0);
      place = Vector3d(end, 0.0, height) + (half_breadth - in) * out;
    }
    place.y() *= side;
    place.z() -= cut_mm;
    foot.cloud.positions.push_back(size * place);
  }
  foot.landmarks["acropodion"].position_mm = Vector3d(length_mm, 0.0, 0.0);
  return foot;
}

/// Cut off higher than 7 mm this edge, in a circular arc, is too upright over what an end is told
/// by.
TEST(FloorBelow, IsToldByHowFarTheEdgeHasBent) {
  for (const double cut : {1.0, 3.0, 6.0, 7.0}) {
    const auto floor = floor_below(walls(cut, 260.0));
    ASSERT_TRUE(floor) << cut;
    EXPECT_NEAR(floor->depth_mm, cut, floor->u95_mm) << cut;
    EXPECT_NEAR(floor->u95_mm, 0.5 * floor->depth_mm, 1e-9) << cut;
  }
}

TEST(FloorBelow, IsToldByNothingWhereTheEdgeWasNotSeen) {
  for (const double cut : {12.0, 20.0, 30.0}) EXPECT_FALSE(floor_below(walls(cut, 260.0))) << cut;
}

TEST(FloorBelow, LiesInProportionUnderASmallFoot) {
  const auto large = floor_below(walls(4.0, 260.0));
  const auto small = floor_below(walls(4.0, 150.0));
  ASSERT_TRUE(large && small);
  EXPECT_NEAR(small->depth_mm / large->depth_mm, 150.0 / 260.0, 0.01);
}

TEST(FloorBelow, IsNoneWhereTheFloorIsKnown) {
  FootScan foot = walls(4.0, 260.0);
  foot.is_floor_known = true;
  const auto floor = floor_below(foot);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->depth_mm, 0.0);
  EXPECT_EQ(floor->u95_mm, 0.0);
  EXPECT_TRUE(if_deeper(foot).empty());
}

}  // namespace
}  // namespace instep
