#include "core/fusion/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace instep {
namespace {

/// A dense sheet of 40,000 points, then strays.
PointCloud sheet_with(const std::vector<Eigen::Vector3d>& strays) {
  PointCloud cloud;
  for (int x = 0; x < 200; ++x) {
    for (int y = 0; y < 200; ++y) cloud.positions.emplace_back(0.8 * x, 0.8 * y, 0.02 * x);
  }
  cloud.positions.insert(cloud.positions.end(), strays.begin(), strays.end());
  return cloud;
}

TEST(CrowdedPoints, AreTheSheetWithoutTheStrays) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(0, 160);
  std::vector<Eigen::Vector3d> strays;
  for (int i = 0; i < 150; ++i)
    strays.emplace_back(uniform(random), uniform(random), 20 + uniform(random));
  const auto kept = crowded_points(sheet_with(strays));
  EXPECT_EQ(kept.size(), 40000U);
  EXPECT_EQ(kept.back(), 39999U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
}

TEST(ClusteredPoints, AreTheSheetWithoutSmallGroups) {
  std::vector<Eigen::Vector3d> group;
  for (int i = 0; i < 45; ++i) group.emplace_back(80 + 0.3 * i, 80, 30);
  EXPECT_EQ(clustered_points(sheet_with(group)).size(), 40000U);
  for (int i = 0; i < 10; ++i) group.emplace_back(80 + 0.3 * i, 81, 30);
  EXPECT_EQ(clustered_points(sheet_with(group)).size(), 40055U);
}

TEST(Outliers, OfNothingAreNothing) {
  EXPECT_TRUE(crowded_points({}).empty());
  EXPECT_TRUE(clustered_points({}).empty());
}

}  // namespace
}  // namespace instep
