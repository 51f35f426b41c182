#include "core/geometry/distinct_points.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace instep {
namespace {

using Indices = std::vector<std::size_t>;

TEST(DistinctPoints, AreTheFirstAtEachPlaceInTheirOrder) {
  const std::vector<Eigen::Vector3d> points = {{3, 1, 0}, {1, 1, 1}, {3, 1, 0},
                                               {0, 0, 0}, {1, 1, 1}, {-0.0, 0, 0}};
  EXPECT_EQ(distinct_points(points), (Indices{0, 1, 3}));
}

TEST(FirstAtSamePlace, IsTheEarliestOfThoseThere) {
  const std::vector<Eigen::Vector3d> points = {{3, 1, 0}, {1, 1, 1}, {3, 1, 0}, {3, 1, 1e-15},
                                               {0, 0, 0}, {1, 1, 1}, {3, 1, 0}, {-0.0, 0, 0}};
  EXPECT_EQ(first_at_same_place(points), (Indices{0, 1, 0, 3, 4, 1, 0, 4}));
  EXPECT_EQ(first_at_same_place({{5, 5, 5}}), (Indices{0}));
  EXPECT_TRUE(first_at_same_place({}).empty());
}

TEST(DistinctPoints, KeepsWhatIsOnlyNear) {
  EXPECT_EQ(distinct_points({{1, 0, 0}, {1, 0, 1e-15}}), (Indices{0, 1}));
}

TEST(DistinctPoints, OfNoPointsAreNone) {
  EXPECT_TRUE(distinct_points(std::vector<Eigen::Vector3d>{}).empty());
  EXPECT_TRUE(distinct_points(PointCloud{}).empty());
}

/// Three copies of one place between two others, told of differently.
PointCloud with_copies() {
  PointCloud cloud;
  cloud.positions = {{5, 0, 0}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {0, 0, 0}};
  return cloud;
}

TEST(DistinctPoints, OfACloudOfWhichNothingIsToldAreTheFirst) {
  EXPECT_EQ(distinct_points(with_copies()), (Indices{0, 1, 4}));
}

TEST(DistinctPoints, AreThoseOfTheLargestSigma) {
  PointCloud cloud = with_copies();
  cloud.sigma_mm = {1.0, 0.2, 0.7, 0.5, 1.0};
  EXPECT_EQ(distinct_points(cloud), (Indices{0, 2, 4}));
}

TEST(DistinctPoints, AreThoseThatWereSeen) {
  PointCloud cloud = with_copies();
  cloud.sigma_mm = {1.0, 0.2, 0.7, 0.5, 1.0};
  cloud.origins.assign(5, PointOrigin::kSeen);
  cloud.origins[2] = PointOrigin::kPlatform;
  EXPECT_EQ(distinct_points(cloud), (Indices{0, 3, 4}));
}

TEST(DistinctPoints, SayTheSameInAnyOrderOfTheCloud) {
  PointCloud cloud = with_copies();
  cloud.sigma_mm.assign(5, 0.3);
  cloud.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  Indices order = {0, 1, 2, 3, 4};
  do {
    const PointCloud turned = cloud.subset(order);
    const PointCloud once = turned.subset(distinct_points(turned));
    ASSERT_EQ(once.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      if (once.positions[i].x() != 1.0) continue;
      EXPECT_EQ(once.normals[i], Eigen::Vector3d(0, 0, -1));
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace
}  // namespace instep
