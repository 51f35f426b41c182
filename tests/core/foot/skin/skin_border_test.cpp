#include "core/foot/skin/skin_border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A wall that bulges: an ellipsoid about the origin, its points moved by white noise.
std::vector<Vector3d> ellipsoid(double sigma_mm, std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector3d> points;
  while (points.size() < count) {
    const double z = random.uniform(-1.0, 1.0);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double ring = std::sqrt(1.0 - z * z);
    const Vector3d unit(ring * std::cos(angle), ring * std::sin(angle), z);
    const Vector3d normal = unit.cwiseQuotient(Vector3d(120, 45, 30)).normalized();
    points.push_back(unit.cwiseProduct(Vector3d(120, 45, 30)) +
                     sigma_mm * random.normal() * normal);
  }
  return points;
}

const BorderView kFromAbove{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(), -20.0, 20.0};

double true_reach(double x) {
  return 45.0 * std::sqrt(1.0 - x * x / (120.0 * 120.0));
}

TEST(SkinBorder, EndsWithItsPoints) {
  auto points = ellipsoid(0.3, 30000, 3);
  std::erase_if(points, [](const Vector3d& point) { return point.x() > 60.0; });
  const SkinBorder border(points, kFromAbove, 9.0);
  EXPECT_NEAR(border.reach(58.0).value(), true_reach(58.0), 0.3);
  EXPECT_FALSE(border.reach(62.5));
}

TEST(SkinBorder, GoesOnAcrossAHole) {
  auto points = ellipsoid(0.1, 30000, 7);
  std::erase_if(points, [](const Vector3d& point) { return std::abs(point.x() - 5.0) < 10.0; });
  const SkinBorder border(points, kFromAbove, 9.0);
  for (double x = -5.0; x <= 15.0; x += 2.0) {
    const auto reach = border.reach(x);
    ASSERT_TRUE(reach) << x;
    EXPECT_NEAR(*reach, true_reach(x), 0.2) << x;
  }
}

TEST(SkinBorder, TellsHowItBends) {
  const SkinBorder border(ellipsoid(0.0, 30000, 8), kFromAbove, 15.0);
  const auto place = border.at(0.0);
  ASSERT_TRUE(place);
  // An ellipse of half axes a and b bends by b / a^2 at the end of b.
  EXPECT_NEAR(place->bend, -45.0 / (120.0 * 120.0), 0.001);
}

TEST(SkinBorder, IsNotPulledOutwardsByNoise) {
  for (const double sigma : {0.0, 0.3, 0.6}) {
    const SkinBorder border(ellipsoid(sigma, 30000, 3), kFromAbove, 9.0);
    double mean = 0.0;
    int count = 0;
    for (double x = -70.0; x <= 70.0; x += 10.0) {
      const auto reach = border.reach(x);
      ASSERT_TRUE(reach) << x;
      EXPECT_NEAR(*reach, true_reach(x), 0.1 + sigma) << x;
      mean += *reach - true_reach(x);
      ++count;
    }
    EXPECT_NEAR(mean / count, 0.0, 0.06 + 0.15 * sigma) << sigma;
  }
}

TEST(SkinBorder, FindsItsFurthestPlaceAndItsHeight) {
  const SkinBorder border(ellipsoid(0.2, 30000, 4), kFromAbove, 9.0);
  const auto peak = border.furthest(-60.0, 60.0);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->along, 0.0, 12.0);
  EXPECT_NEAR(peak->reach, 45.0, 0.2);
  EXPECT_NEAR(peak->across, 0.0, 3.0);
  EXPECT_LT((border.position(*peak) - Vector3d(peak->along, peak->reach, peak->across)).norm(),
            1e-9);
}

TEST(SkinBorder, StaysWithinItsLimitsAcross) {
  BorderView low = kFromAbove;
  low.across_from_mm = -25.0;
  low.across_to_mm = -15.0;
  const SkinBorder border(ellipsoid(0.0, 30000, 5), low, 9.0);
  const auto place = border.at(0.0);
  ASSERT_TRUE(place);
  // At z = -15 of 30 the ellipse has shrunk to the root of three quarters.
  EXPECT_NEAR(place->reach, 45.0 * std::sqrt(0.75), 0.15);
  EXPECT_NEAR(place->across, -15.0, 0.5);
}

TEST(SkinBorder, KnowsNothingWhereThereAreNoPoints) {
  const SkinBorder border(ellipsoid(0.0, 30000, 6), kFromAbove, 9.0);
  EXPECT_FALSE(border.at(200.0));
  EXPECT_FALSE(SkinBorder({}, kFromAbove, 9.0).at(0.0));
  EXPECT_FALSE(SkinBorder({}, kFromAbove, 9.0).furthest(-10.0, 10.0));
  EXPECT_TRUE(border.furthest(-10.0, 10.0));
  EXPECT_FALSE(border.furthest(10.0, -10.0));
}

}  // namespace
}  // namespace instep
