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

}  // namespace
}  // namespace instep
