#include "core/foot/quieted.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::RandomNumbers;

constexpr double kRadius = 40.0;

/// On a sphere about the origin, with noise in all directions.
PointCloud ball(std::size_t count, double noise_mm) {
  RandomNumbers random(7);
  const auto normal = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d direction = normal().normalized();
    cloud.positions.push_back(kRadius * direction + noise_mm * normal());
  }
  return cloud;
}

double off_the_ball(const PointCloud& cloud) {
  double squares = 0.0;
  for (const auto& point : cloud.positions) squares += std::pow(point.norm() - kRadius, 2);
  return std::sqrt(squares / static_cast<double>(cloud.size()));
}

TEST(Quieted, LeavesAQuietCloudAlone) {
  EXPECT_FALSE(quieted_if_noisy(ball(5000, 0.0)));
  EXPECT_FALSE(quieted_if_noisy(ball(5000, 0.05)));
  EXPECT_FALSE(quieted_if_noisy(ball(400, 0.0)));
}

TEST(Quieted, TellsTheNoiseAndTakesMostOfItOut) {
  for (const double noise_mm : {0.5, 1.0, 2.0}) {
    const auto quiet = quieted_if_noisy(ball(8000, noise_mm));
    ASSERT_TRUE(quiet) << noise_mm;
    EXPECT_NEAR(quiet->noise_mm, noise_mm, 0.15 * noise_mm);
    EXPECT_EQ(quiet->cloud.size(), 8000U);
    EXPECT_LT(off_the_ball(quiet->cloud), 0.4 * noise_mm);
  }
}

TEST(Quieted, KeepsNoMorePointsThanShowAFoot) {
  const auto quiet = quieted_if_noisy(ball(50000, 1.0));
  ASSERT_TRUE(quiet);
  EXPECT_EQ(quiet->cloud.size(), 20000U);
  EXPECT_LT(off_the_ball(quiet->cloud), 0.25);
}

TEST(Quieted, MovesNeitherStraysNorWhatNobodySaw) {
  PointCloud cloud = ball(8000, 1.0);
  const Vector3d stray(0.0, 0.0, kRadius + 8.0);
  const Vector3d unseen(0.0, kRadius + 1.5, 0.0);
  cloud.positions.push_back(stray);
  cloud.positions.push_back(unseen);
  cloud.origins.assign(cloud.size(), PointOrigin::kSeen);
  cloud.origins.back() = PointOrigin::kPlatform;
  const auto quiet = quieted(cloud, 1.0, kMostQuieted);
  EXPECT_EQ(quiet.positions[8000], stray);
  EXPECT_EQ(quiet.positions[8001], unseen);
  EXPECT_FALSE(quiet.was_seen(8001));
}

}  // namespace
}  // namespace instep
