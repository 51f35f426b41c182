#include "core/foot/cloud/quieted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::RandomNumbers;

constexpr double kRadius = 40.0;
constexpr double kFullLength = 260.0;

PointCloud ball(std::size_t count, double noise_mm, double radius = kRadius) {
  RandomNumbers random(7);
  const auto normal = [&] { return Vector3d(random.normal(), random.normal(), random.normal()); };
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d direction = normal().normalized();
    cloud.positions.push_back(radius * direction + noise_mm * normal());
  }
  return cloud;
}

/// Root mean square, of the points that `counts` tells.
template <class Counts>
double off_the_ball(const PointCloud& cloud, const Counts& counts) {
  double squares = 0.0;
  double count = 0.0;
  for (const auto& point : cloud.positions) {
    if (!counts(point)) continue;
    squares += std::pow(point.norm() - kRadius, 2);
    count += 1.0;
  }
  return std::sqrt(squares / count);
}

double off_the_ball(const PointCloud& cloud) {
  return off_the_ball(cloud, [](const Vector3d&) { return true; });
}

double mean_radius(const PointCloud& cloud) {
  double sum = 0.0;
  for (const auto& point : cloud.positions) sum += point.norm();
  return sum / static_cast<double>(cloud.size());
}

TEST(Quieted, TellsTheNoiseThatMovesPoints) {
  for (const double noise_mm : {0.5, 1.0, 2.0}) {
    const auto told = moving_noise_mm(ball(8000, noise_mm));
    ASSERT_TRUE(told) << noise_mm;
    EXPECT_NEAR(*told, noise_mm, 0.15 * noise_mm);
  }
  EXPECT_FALSE(moving_noise_mm(ball(5000, 0.0)));
  EXPECT_FALSE(moving_noise_mm(ball(5000, 0.05)));
  EXPECT_FALSE(moving_noise_mm(ball(400, 0.0)));
}

// Their nearest ones are no thicker than they are wide, a round heap of which noise is as little
// told as skin is.
TEST(Quieted, TellsTheNoiseOfPointsThatCrowd) {
  for (const double noise_mm : {1.0, 2.0}) {
    const auto told = moving_noise_mm(ball(300000, noise_mm));
    ASSERT_TRUE(told) << noise_mm;
    EXPECT_NEAR(*told, noise_mm, 0.1 * noise_mm);
  }
}

TEST(Quieted, TakesMostOfTheNoiseOut) {
  for (const double noise_mm : {0.5, 1.0, 2.0}) {
    const auto quiet = quieted(ball(8000, noise_mm), {noise_mm, kFullLength});
    EXPECT_EQ(quiet.cloud.size(), 8000U);
    EXPECT_LT(off_the_ball(quiet.cloud), 0.4 * noise_mm);
  }
}

TEST(Quieted, KeepsNoMorePointsThanShowAFoot) {
  const auto quiet = quieted(ball(50000, 1.0), {1.0, kFullLength});
  EXPECT_EQ(quiet.cloud.size(), 20000U);
  EXPECT_LT(off_the_ball(quiet.cloud), 0.25);
}

// All points are asked, kept or not, and of a part as many less as it is smaller.
TEST(Quieted, TellsMoreByMorePoints) {
  const double few = off_the_ball(quieted(ball(18750, 1.0), {1.0, kFullLength}).cloud);
  const double whole = off_the_ball(quieted(ball(150000, 1.0), {1.0, kFullLength}).cloud);
  EXPECT_LT(whole, 0.6 * few);
  const double part = off_the_ball(quieted(ball(18750, 1.0), {1.0, kFullLength, 8}).cloud);
  // Of the root of eight, for the whole one has the bend of the ball in it as well.
  EXPECT_NEAR(part / whole, 2.5, 0.5);
}

// One circle for all held too few of the sparse side, which was left as it was.
TEST(Quieted, TakesTheNoiseOutOfASparseSideToo) {
  PointCloud cloud;
  std::size_t below = 0;
  for (const auto& point : ball(14000, 0.5).positions) {
    if (point.z() > 0.0 || ++below % 12 == 0) cloud.positions.push_back(point);
  }
  const auto quiet = quieted(cloud, {0.5, kFullLength});
  EXPECT_LT(off_the_ball(quiet.cloud, [](const auto& point) { return point.z() < -5.0; }), 0.25);
}

// As round as a child's toe: a circle for a large foot reaches round it.
TEST(Quieted, LooksLessFarRoundASmallFoot) {
  const auto toe = ball(8000, 2.0, 8.0);
  EXPECT_LT(mean_radius(quieted(toe, {2.0, kFullLength}).cloud), 6.5);
  EXPECT_GT(mean_radius(quieted(toe, {2.0, 0.4 * kFullLength}).cloud), 7.2);
}

// Of those in a ball round a place, more were noise towards it.
TEST(Quieted, HardlyBendsSkinInwards) {
  const auto heel = ball(8000, 1.0, 30.0);
  EXPECT_NEAR(mean_radius(quieted(heel, {1.0, kFullLength}).cloud), 30.0, 0.05);
}

TEST(Quieted, IsTheSameInWhateverOrderPointsCome) {
  const PointCloud cloud = ball(30000, 1.0);
  PointCloud reversed;
  reversed.positions.assign(cloud.positions.rbegin(), cloud.positions.rend());
  const auto one = quieted(cloud, {1.0, kFullLength}).cloud;
  const auto other = quieted(reversed, {1.0, kFullLength}).cloud;
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_LT((one.positions[i] - other.positions[i]).norm(), 1e-9) << i;
  }
}

TEST(Quieted, MovesNeitherStraysNorWhatNobodySaw) {
  PointCloud cloud = ball(8000, 1.0);
  const Vector3d stray(0.0, 0.0, kRadius + 8.0);
  const Vector3d unseen(0.0, kRadius + 1.5, 0.0);
  cloud.positions.push_back(stray);
  cloud.positions.push_back(unseen);
  cloud.origins.assign(cloud.size(), PointOrigin::kSeen);
  cloud.origins.back() = PointOrigin::kPlatform;
  const auto quiet = quieted(cloud, {1.0, kFullLength}).cloud;
  const auto has = [&](const Vector3d& place) {
    return std::count(quiet.positions.begin(), quiet.positions.end(), place) == 1;
  };
  EXPECT_TRUE(has(stray));
  EXPECT_TRUE(has(unseen));
}

}  // namespace
}  // namespace instep
