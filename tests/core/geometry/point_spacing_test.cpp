#include "core/geometry/point_spacing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

TEST(SpacingWithin, IsTheSideOfTheSquareThatEachHas) {
  EXPECT_DOUBLE_EQ(std::pow(spacing_within(3.0, 100), 2) * 100.0, 9.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(spacing_within(3.0, 0), spacing_within(3.0, 1));
}

Points grid(int side, double pitch) {
  Points points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) points.emplace_back(pitch * i, pitch * j, 7.0);
  }
  return points;
}

/// The eighth neighbour is across the diagonal: eight points share a circle of that radius.
TEST(UsualSpacing, OfAGridIsThatOfItsDiagonalNeighbours) {
  for (const double pitch : {0.01, 1.0, 30.0}) {
    const PointIndex index(grid(30, pitch));
    EXPECT_NEAR(usual_spacing(index, 900), pitch * std::sqrt(2.0 * std::numbers::pi / 8.0),
                1e-12 * pitch);
  }
}

TEST(UsualSpacing, OfRandomPointsIsTheSideOfTheSquareThatEachHas) {
  test::RandomNumbers random(6);
  Points points;
  for (int i = 0; i < 10000; ++i) {
    points.emplace_back(random.uniform(0.0, 50.0), random.uniform(0.0, 50.0), 0.0);
  }
  EXPECT_NEAR(usual_spacing(PointIndex(points), 500), 0.5, 0.03);
}

TEST(UsualSpacing, IsZeroWhereThereIsNone) {
  EXPECT_EQ(usual_spacing(PointIndex({}), 10), 0.0);
  EXPECT_EQ(usual_spacing(PointIndex({Vector3d(1, 2, 3)}), 10), 0.0);
  EXPECT_EQ(usual_spacing(PointIndex(Points(50, Vector3d(1, 2, 3))), 10), 0.0);
  EXPECT_GT(usual_spacing(PointIndex({Vector3d(1, 2, 3), Vector3d(1, 2, 4)}), 10), 0.0);
}

TEST(MedianNearestDistance, IsThePitchOfAGrid) {
  EXPECT_NEAR(median_nearest_distance(PointIndex(grid(20, 1.5))), 1.5, 1e-12);
}

/// Of points at random (Clark and Evans 1954 for the mean; the median by exp(-pi r^2) = 1/2).
TEST(MedianNearestDistance, OfRandomPointsIsHalfTheirSpacing) {
  test::RandomNumbers random(7);
  Points points;
  for (int i = 0; i < 20000; ++i) {
    points.emplace_back(random.uniform(0.0, 100.0), random.uniform(0.0, 100.0), 0.0);
  }
  const PointIndex index(points);
  const double expected =
      std::sqrt(std::numbers::ln2 / std::numbers::pi) * usual_spacing(index, 2000);
  EXPECT_NEAR(median_nearest_distance(index) / expected, 1.0, 0.03);
}

TEST(MedianNearestDistance, IsZeroWhereThereIsNone) {
  EXPECT_EQ(median_nearest_distance(PointIndex({})), 0.0);
  EXPECT_EQ(median_nearest_distance(PointIndex({Vector3d(1, 2, 3)})), 0.0);
}

}  // namespace
}  // namespace instep
