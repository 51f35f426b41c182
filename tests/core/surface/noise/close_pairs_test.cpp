#include "core/surface/noise/close_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 0.02;
constexpr std::size_t kPoints = 3000;

/// Random over a square, with a height each and normals that know of none.
std::vector<OrientedPoint> over_square(const std::function<double(double x, double y)>& height,
                                       std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double side = kSpacing * std::sqrt(static_cast<double>(kPoints));
  std::vector<OrientedPoint> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double x = random.uniform(0.0, side);
    const double y = random.uniform(0.0, side);
    points.push_back({Vector3d(x, y, height(x, y)), Vector3d::UnitZ()});
  }
  return points;
}

/// None near to another, each with noise of its own.
std::vector<OrientedPoint> on_grid(double sigma) {
  test::RandomNumbers random(7);
  std::vector<OrientedPoint> points;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d place(kSpacing * (i % 32), kSpacing * (i / 32), sigma * random.normal());
    points.push_back({place, Vector3d::UnitZ()});
  }
  return points;
}

bool is_noise(const std::vector<OrientedPoint>& points, double sigma) {
  return is_noise_between_pairs(points, PointIndex(test::positions_of(points)), kSpacing, sigma);
}

TEST(ClosePairs, ShowNoise) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const double sigma : {1e-3 * kSpacing, 1e-2 * kSpacing}) {
      test::RandomNumbers random(100 + seed);
      const auto noise = [&](double, double) { return sigma * random.normal(); };
      EXPECT_TRUE(is_noise(over_square(noise, seed), sigma)) << seed;
    }
  }
}

/// Facets as wide as the points are apart, which lean four ways: as uneven as by noise, near points
/// too.
TEST(ClosePairs, ShowThatFacetsAreNoNoise) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const double sigma = 5e-3 * kSpacing;
    const auto facets = [&](double x, double y) {
      const double wave = 2.0 * kSpacing;
      const auto zigzag = [&](double at) { return std::abs(at / wave - std::round(at / wave)); };
      return 20.0 * sigma * (zigzag(x) + zigzag(y));
    };
    EXPECT_FALSE(is_noise(over_square(facets, seed), sigma)) << seed;
  }
}

TEST(ClosePairs, ThatScatterFarLessThanTheNoiseInQuestionAreNotOfIt) {
  test::RandomNumbers random(7);
  const auto noise = [&](double, double) { return 1e-3 * kSpacing * random.normal(); };
  EXPECT_FALSE(is_noise(over_square(noise, 1), 1e-2 * kSpacing));
}

/// What copies differ by is no noise of theirs.
TEST(ClosePairs, OfCopiesTellNothing) {
  test::RandomNumbers random(8);
  const double sigma = 5e-3 * kSpacing;
  auto points = on_grid(sigma);
  for (std::size_t i = 0; i < 1000; ++i) {
    const Vector3d off(kSpacing * random.uniform(0.0, 0.01), 0.0, 1e-3 * sigma * random.normal());
    points.push_back({points[i].position + off, Vector3d::UnitZ()});
  }
  EXPECT_FALSE(is_noise(points, 1e-3 * sigma));
}

/// Pairs along a body that is steep at one end, all equally far apart.
TEST(ClosePairs, OfOneDistanceTellNothing) {
  const double sigma = 5e-3 * kSpacing;
  std::vector<OrientedPoint> points;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d place(0.0, kSpacing * i, 0.0);
    const Vector3d normal = Vector3d(0.2 - 1e-4 * i, 0.0, 1.0).normalized();
    points.push_back({place, normal});
    points.push_back({place + Vector3d(0.125 * kSpacing, 0.0, 0.0), normal});
  }
  EXPECT_FALSE(is_noise(points, sigma));
}

TEST(ClosePairs, TellTheSameInAnyOrder) {
  test::RandomNumbers random(7);
  const double sigma = 5e-3 * kSpacing;
  const auto points = over_square([&](double, double) { return sigma * random.normal(); }, 1);
  EXPECT_TRUE(is_noise(points, sigma));
  EXPECT_TRUE(is_noise(test::in_another_order(points, 1), sigma));
}

TEST(ClosePairs, AreMissingWherePointsAreEven) {
  const double sigma = 5e-3 * kSpacing;
  EXPECT_FALSE(is_noise(on_grid(sigma), sigma));
  EXPECT_FALSE(is_noise({}, sigma));
}

}  // namespace
}  // namespace instep
