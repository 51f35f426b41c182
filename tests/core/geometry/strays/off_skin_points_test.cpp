#include "core/geometry/strays/off_skin_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kSpacing = 0.1;
/// Half a hundredth of the points: noise has its own strays.
constexpr int kMostFalse = 6;

/// Of radius one, a tenth apart, with noise.
Points sphere(double sigma) {
  Points points = test::positions_of(test::sphere_points(1.0, 1200, 0.003, 4));
  test::RandomNumbers random(9);
  for (auto& point : points) point *= 1.0 + sigma * random.normal();
  return points;
}

std::ptrdiff_t found_in(const Points& points) {
  const auto off = off_skin_points(PointIndex(points), kSpacing);
  return std::count(off.begin(), off.end(), true);
}

TEST(OffSkinPoints, AreThoseThatRiseFromTheSkin) {
  for (const double sigma : {0.0, 0.005, 0.02}) {
    Points points = sphere(sigma);
    std::vector<bool> moved(points.size(), false);
    for (std::size_t i = 0; i < points.size(); i += 30) {
      points[i] *= i % 60 == 0 ? 1.25 : 0.8;
      moved[i] = true;
    }
    const auto off = off_skin_points(PointIndex(points), kSpacing);
    int misses = 0;
    int false_alarms = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      misses += moved[i] && !off[i];
      false_alarms += !moved[i] && off[i];
    }
    EXPECT_EQ(misses, 0) << sigma;
    EXPECT_LE(false_alarms, kMostFalse) << sigma;
  }
}

TEST(OffSkinPoints, AreNoneOfNoise) {
  EXPECT_EQ(found_in(sphere(0.0)), 0);
  EXPECT_LE(found_in(sphere(0.03)), kMostFalse);
  EXPECT_LE(found_in(sphere(0.1)), kMostFalse);
}

TEST(OffSkinPoints, AreNoneOfACrease) {
  Points roof;
  for (double x = -1.0; x < 1.01; x += kSpacing) {
    for (double y = -1.0; y < 1.01; y += kSpacing) {
      roof.emplace_back(x + 0.3 * kSpacing * std::sin(70.0 * y), y, -1.7 * std::abs(x));
    }
  }
  EXPECT_EQ(found_in(roof), 0);
}

TEST(OffSkinPoints, AreNoneOfTooFew) {
  EXPECT_EQ(found_in({}), 0);
  EXPECT_EQ(found_in(Points(10, Vector3d::Zero())), 0);
}

}  // namespace
}  // namespace instep
