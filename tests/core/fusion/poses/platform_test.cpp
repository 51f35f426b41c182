#include "core/fusion/poses/platform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/degree.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A platform of 600 x 400 mm, tilted about x, with a foot-like clutter above one part of it.
std::vector<Vector3d> platform_points(double height, double tilt_deg, double sigma,
                                      double clutter_share) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  const int count = 30000;
  for (int i = 0; i < count; ++i) {
    const double x = 300 * uniform(random);
    const double y = 200 * uniform(random);
    if (0.5 * (uniform(random) + 1) < clutter_share) {
      points.emplace_back(0.4 * x, 0.3 * y + 30, height + 45 * (uniform(random) + 1));
    } else {
      points.emplace_back(x, y, height + std::tan(tilt_deg * kDegree) * y + sigma * normal(random));
    }
  }
  return points;
}

double tilt_error_deg(const FoundPlatform& platform, double tilt_deg) {
  const Vector3d truth(0, -std::sin(tilt_deg * kDegree), std::cos(tilt_deg * kDegree));
  return std::acos(std::min(1.0, platform.normal.dot(truth))) / kDegree;
}

TEST(FindPlatform, FindsThePlaneInClutter) {
  for (const double sigma : {0.1, 0.5, 1.2}) {
    for (const double tilt : {0.0, 1.5, -3.0}) {
      PlatformSettings settings;
      settings.expected_height_mm = 10.0;
      const auto platform = find_platform(platform_points(14.0, tilt, sigma, 0.2), settings);
      ASSERT_TRUE(platform) << sigma << " " << tilt;
      EXPECT_LT(tilt_error_deg(*platform, tilt), 0.1);
      const double at_origin = -platform->distance({0, 0, 14.0}) / platform->normal.z();
      EXPECT_NEAR(at_origin, 0.0, 0.2);
      EXPECT_NEAR(platform->scatter_mm, sigma, 0.25 * sigma + 0.05);
    }
  }
}

TEST(FindPlatform, NeedsNoExpectedHeight) {
  const auto platform = find_platform(platform_points(-380.0, 1.0, 0.4, 0.3), {});
  ASSERT_TRUE(platform);
  EXPECT_LT(tilt_error_deg(*platform, 1.0), 0.1);
}

TEST(FindPlatform, FindsNoneWhereThereIsNone) {
  PlatformSettings settings;
  settings.expected_height_mm = 0.0;
  EXPECT_FALSE(find_platform({}, settings));
  EXPECT_FALSE(find_platform(std::vector<Vector3d>(5000, Vector3d(1, 2, 3)), settings));
  // Only walls of feet.
  std::vector<Vector3d> walls;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 0.01 * i;
    walls.emplace_back(120 * std::cos(angle), 45 * std::sin(angle), 0.004 * i);
  }
  EXPECT_FALSE(find_platform(walls, settings));
  // A line of points spans no plane.
  std::vector<Vector3d> line;
  for (int i = 0; i < 5000; ++i) line.emplace_back(0.1 * i, 0.05 * i, 0);
  EXPECT_FALSE(find_platform(line, settings));
}

/// Where the search ends within a wall, there are points on one side of its end alone.
TEST(FindPlatform, TakesNoWallForOneAtTheEndOfTheSearch) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vector3d> wall;
  for (int i = 0; i < 30000; ++i) {
    const double turn = 2 * std::numbers::pi * uniform(random);
    const double z = 90 * std::sqrt(uniform(random));
    wall.emplace_back(120 * std::cos(turn), 50 * std::sin(turn), z);
  }
  PlatformSettings settings;
  EXPECT_FALSE(find_platform(wall, settings));
  settings.expected_height_mm = 0.0;
  EXPECT_FALSE(find_platform(wall, settings));
}

TEST(FindPlatform, RespectsTheLimitsOfHeightAndTilt) {
  PlatformSettings settings;
  settings.expected_height_mm = 100.0;
  EXPECT_FALSE(find_platform(platform_points(0.0, 0.0, 0.3, 0.1), settings));
  settings.expected_height_mm = 0.0;
  EXPECT_FALSE(find_platform(platform_points(0.0, 9.0, 0.3, 0.0), settings));
}

TEST(Platform, LevelsTheStationAboutItsCentre) {
  FoundPlatform platform;
  platform.centre = {30, -20, 7};
  platform.normal = Vector3d(0.03, -0.05, 1).normalized();
  const auto level = platform.level_from_station();
  EXPECT_NEAR((level.linear() * platform.normal - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((level * platform.centre - platform.centre).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace instep
