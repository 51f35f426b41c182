#include "core/foot/cloud/left_out_strays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::RandomNumbers;

constexpr double kRadius = 60.0;
constexpr std::size_t kDense = 150000;

/// On a sphere, and as many strays up to 40 mm off it.
PointCloud ball(std::size_t count, std::size_t strays) {
  RandomNumbers random(23);
  const auto way = [&] {
    return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  };
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) cloud.positions.push_back(kRadius * way());
  for (std::size_t i = 0; i < strays; ++i) {
    cloud.positions.push_back((kRadius + random.uniform(5.0, 40.0)) * way());
  }
  return cloud;
}

std::size_t strays_in(const PointCloud& cloud) {
  std::size_t strays = 0;
  for (const auto& point : cloud.positions) strays += point.norm() > kRadius + 1.0;
  return strays;
}

TEST(LeftOutStrays, AreAllThatLieOffTheSkin) {
  PointCloud cloud = ball(20000, 400);
  EXPECT_NEAR(leave_out_strays(cloud).share, 400.0 / 20400.0, 0.001);
  EXPECT_EQ(strays_in(cloud), 0U);
  EXPECT_GT(cloud.size(), 19990U);
}

TEST(LeftOutStrays, OfADenseCloudAreThoseThatStandAlone) {
  PointCloud cloud = ball(kDense, 5);
  EXPECT_GT(leave_out_strays(cloud).share, 0.0);
  EXPECT_EQ(strays_in(cloud), 0U);
  EXPECT_GT(cloud.size(), kDense - 100);
}

// They have each other for neighbours.
TEST(LeftOutStrays, OfADenseCloudWithManyLeaveSomeOfItsPoints) {
  PointCloud cloud = ball(kDense, kDense / 50);
  EXPECT_NEAR(leave_out_strays(cloud).share, 0.02, 0.002);
  EXPECT_EQ(strays_in(cloud), 0U);
  EXPECT_GT(cloud.size(), 58000U);
  EXPECT_LE(cloud.size(), 60000U);
}

TEST(LeftOutStrays, AreClumpsThatNoSkinReaches) {
  for (const std::size_t skin : {std::size_t{20000}, kDense}) {
    PointCloud cloud = ball(skin, 0);
    RandomNumbers random(29);
    for (int i = 0; i < 12; ++i) {
      cloud.positions.emplace_back(random.normal(), random.normal(),
                                   kRadius + 12 + random.normal());
    }
    EXPECT_TRUE(leave_out_strays(cloud).any_clump);
    EXPECT_EQ(strays_in(cloud), 0U);
    EXPECT_GT(cloud.size(), skin - 10);
  }
}

TEST(LeftOutStrays, AreNoneOfACloudThatWasFilledUp) {
  PointCloud cloud = ball(5000, 20);
  cloud.origins.assign(cloud.size(), PointOrigin::kSeen);
  EXPECT_EQ(leave_out_strays(cloud).share, 0.0);
  EXPECT_EQ(cloud.size(), 5020U);
}

TEST(LeftOutStrays, AreNoneOfOnePlaceOrNoPoints) {
  PointCloud cloud;
  EXPECT_EQ(leave_out_strays(cloud).share, 0.0);
  cloud.positions.assign(300, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(leave_out_strays(cloud).share, 0.0);
  EXPECT_EQ(cloud.size(), 300U);
}

}  // namespace
}  // namespace instep
