#include "core/geometry/distinct_points.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using Indices = std::vector<std::size_t>;

TEST(DistinctPoints, AreTheFirstAtEachPlaceInTheirOrder) {
  const std::vector<Eigen::Vector3d> points = {{3, 1, 0}, {1, 1, 1}, {3, 1, 0},
                                               {0, 0, 0}, {1, 1, 1}, {-0.0, 0, 0}};
  EXPECT_EQ(distinct_points(points), (Indices{0, 1, 3}));
}

TEST(DistinctPoints, KeepsWhatIsOnlyNear) {
  EXPECT_EQ(distinct_points({{1, 0, 0}, {1, 0, 1e-15}}), (Indices{0, 1}));
}

TEST(DistinctPoints, OfNoPointsAreNone) {
  EXPECT_TRUE(distinct_points({}).empty());
}

}  // namespace
}  // namespace instep
