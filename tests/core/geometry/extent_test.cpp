#include "core/geometry/extent.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace instep {
namespace {

TEST(Extent, ReachesFromTheFirstToTheLastPointAlongADirection) {
  const std::vector<Eigen::Vector2d> points = {{1.0, 7.0}, {-3.0, 0.0}, {2.0, -9.0}};
  const Extent along_x = extent_along<Eigen::Vector2d>(points, {1.0, 0.0});
  EXPECT_EQ(along_x.from, -3.0);
  EXPECT_EQ(along_x.to, 2.0);
  const Extent backwards = extent_along<Eigen::Vector2d>(points, {-1.0, 0.0});
  EXPECT_EQ(backwards.from, -2.0);
  EXPECT_EQ(backwards.to, 3.0);
  EXPECT_EQ(backwards.length(), 5.0);
}

TEST(Extent, OfOnePointIsNone) {
  EXPECT_EQ(extent_along<Eigen::Vector3d>({{5.0, 6.0, 7.0}}, {0.0, 0.0, 1.0}).length(), 0.0);
}

TEST(Extent, IsNoneUntilSomethingIsIncluded) {
  Extent extent = Extent::none();
  EXPECT_TRUE(extent.is_none());
  EXPECT_FALSE(extent.meets(-1e9, 1e9));
  extent.include(Extent::none());
  EXPECT_TRUE(extent.is_none());
  extent.include(3.0);
  EXPECT_FALSE(extent.is_none());
  EXPECT_EQ(extent.length(), 0.0);
  extent.include({-1.0, 2.0});
  EXPECT_EQ(extent.from, -1.0);
  EXPECT_EQ(extent.to, 3.0);
}

TEST(Extent, MeetsIntervalsUpToItsEnds) {
  const Extent extent{2.0, 5.0};
  EXPECT_TRUE(extent.meets(3.0, 4.0));
  EXPECT_TRUE(extent.meets(0.0, 9.0));
  EXPECT_TRUE(extent.meets(5.0, 9.0));
  EXPECT_TRUE(extent.meets(0.0, 2.0));
  EXPECT_FALSE(extent.meets(5.1, 9.0));
  EXPECT_FALSE(extent.meets(0.0, 1.9));
}

}  // namespace
}  // namespace instep
