// Girths of clouds that have most of their points in a small part.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using test::oblique_plane;
using test::RandomNumbers;

constexpr double kRadius = 40.0;

/// Points of a cylinder with noise, on a strip to each side of the x axis.
struct Strip {
  std::size_t points;
  double half_angle;
  double lowest;
  double highest;
  double sigma_mm;
};

void add(const Strip& strip, RandomNumbers& random, PointCloud& cloud) {
  for (std::size_t i = 0; i < strip.points; ++i) {
    const double angle = random.uniform(-strip.half_angle, strip.half_angle);
    const double radius = kRadius + strip.sigma_mm * random.normal();
    cloud.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 random.uniform(strip.lowest, strip.highest));
  }
}

PointCloud cylinder(double sigma_mm, RandomNumbers& random) {
  PointCloud cloud;
  add({20000, std::numbers::pi, -30.0, 30.0, sigma_mm}, random, cloud);
  return cloud;
}

/// The same, a part of which a second camera saw from near.
PointCloud with_dense_part(double sigma_mm, double sigma_of_part_mm, std::uint64_t seed) {
  RandomNumbers random(seed);
  PointCloud cloud = cylinder(sigma_mm, random);
  add({50000, 0.3, 5.0, 25.0, sigma_of_part_mm}, random, cloud);
  return cloud;
}

/// The same, and a spot on the plane that was seen again and again.
PointCloud with_repeated_spot(double sigma_mm, double sigma_of_spot_mm, std::size_t times) {
  RandomNumbers random(3);
  PointCloud cloud = cylinder(sigma_mm, random);
  const auto plane = oblique_plane();
  const Eigen::Vector3d beside(kRadius, 0.0, 0.0);
  const Eigen::Vector3d spot(kRadius, 0.0, -plane.distance(beside) / plane.normal().z());
  for (std::size_t i = 0; i < times; ++i) {
    const Eigen::Vector3d off(random.normal(), random.normal(), random.normal());
    cloud.positions.push_back(spot + sigma_of_spot_mm * off);
  }
  return cloud;
}

double true_girth() {
  return test::true_girth(test::elliptic_cylinder(kRadius, kRadius), oblique_plane());
}

void expect_right(const PointCloud& cloud, double most_u95_mm) {
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, true_girth(), *girth->contact_u95_mm);
  EXPECT_NEAR(girth->stretched_mm, true_girth(), *girth->stretched_u95_mm);
  EXPECT_LT(*girth->contact_u95_mm, most_u95_mm);
}

/// Contact lengths were up to 27 mm too long where the part had less noise than the rest; with as
/// much the section did not close.
TEST(PiledGirth, IsRightWithAPartEightyTimesAsDense) {
  for (const std::uint64_t seed : {1U, 2U}) {
    expect_right(with_dense_part(0.3, 0.1, seed), 0.3);
    expect_right(with_dense_part(0.6, 0.3, seed), 0.6);
    expect_right(with_dense_part(0.3, 0.3, seed), 0.3);
    expect_right(with_dense_part(0.0, 0.0, seed), 0.005);
  }
}

/// 37 mm too long, within an interval of 9, and 13 mm.
TEST(PiledGirth, IsRightWithASpotThatWasSeenAgainAndAgain) {
  for (const double sigma_of_spot_mm : {0.001, 0.1, 0.3}) {
    expect_right(with_repeated_spot(0.5, sigma_of_spot_mm, 8000), 0.2);
    expect_right(with_repeated_spot(0.2, sigma_of_spot_mm, 30000), 0.1);
  }
}

TEST(PiledGirth, DoesNotDependOnTheOrderOfPoints) {
  PointCloud cloud = with_dense_part(0.3, 0.1, 1);
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  const auto reversed = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth && reversed);
  EXPECT_EQ(reversed->contact_mm, girth->contact_mm);
  EXPECT_EQ(reversed->contact_u95_mm, girth->contact_u95_mm);
}

}  // namespace
}  // namespace instep
