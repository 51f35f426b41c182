// Girths of a body beside an open surface that the tape plane cuts as well: a wall, a floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using test::RandomNumbers;

constexpr double kRadius = test::kCylinderRadius;
constexpr double kHalfHeight = 30.0;

PointCloud body(double a, double b, std::size_t count, double sigma_mm, std::uint64_t seed) {
  return test::random_points(test::elliptic_cylinder(a, b), count, -kHalfHeight, kHalfHeight,
                             sigma_mm, seed);
}

/// So far beside what reaches `radius` along the first axis.
void add_wall(double radius, double apart_mm, double width, std::size_t count, PointCloud& cloud) {
  RandomNumbers random(2);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.emplace_back(-radius - apart_mm, random.uniform(-0.5 * width, 0.5 * width),
                                 random.uniform(-kHalfHeight, kHalfHeight));
  }
}

void add_floor(double below_mm, double width, std::size_t count, double sigma_mm,
               PointCloud& cloud) {
  RandomNumbers random(3);
  for (std::size_t i = 0; i < count; ++i) {
    cloud.positions.emplace_back(random.uniform(-0.5 * width, 0.5 * width),
                                 random.uniform(-0.5 * width, 0.5 * width),
                                 -below_mm + sigma_mm * random.normal());
  }
  std::erase_if(cloud.positions, [&](const Eigen::Vector3d& position) {
    return position.z() < -below_mm - 4.0 * sigma_mm;
  });
}

TapePlane leaning_plane(double degrees) {
  const double turn = degrees * std::numbers::pi / 180.0;
  return test::plane_at({0, 0, 0}, {std::cos(turn), 0, std::sin(turn)}, {0, 1, 0});
}

/// Of many intervals that hold in 95 % of cases.
constexpr double kThreeSigmas = 1.5;

void expect_right_with_a_warning(const PointCloud& cloud, double a, double b,
                                 const TapePlane& plane, double most_u95_mm) {
  const double truth = test::true_girth(test::elliptic_cylinder(a, b), plane);
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, truth, kThreeSigmas * *girth->stretched_u95_mm);
  EXPECT_NEAR(girth->contact_mm, truth, kThreeSigmas * *girth->contact_u95_mm);
  EXPECT_LT(*girth->contact_u95_mm, most_u95_mm);
  EXPECT_EQ(girth->points, cloud.size());
  EXPECT_TRUE(std::any_of(girth->warnings.begin(), girth->warnings.end(), [](const auto& warning) {
    return warning.find(" beside ") != std::string::npos;
  }));
}

/// However many points are of the wall: it closes nowhere, and the body does.
TEST(GirthBesideAWall, IsToldWithAWarning) {
  for (const std::size_t wall : {7200U, 21600U}) {
    PointCloud cloud = body(kRadius, kRadius, 6000, 0.0, 1);
    add_wall(kRadius, 20.0, static_cast<double>(wall) / 24.0, wall, cloud);
    expect_right_with_a_warning(cloud, kRadius, kRadius, test::level_plane(0.0), 0.01);
  }
}

/// As most points are the wall's, the noise was: girths were up to 1.6 mm too long, outside their
/// intervals.
TEST(GirthBesideAWall, HasTheNoiseOfTheBody) {
  for (const double sigma_mm : {0.15, 0.7}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << sigma_mm << " " << seed);
      PointCloud cloud = body(38.0, 27.0, 9000, sigma_mm, seed);
      add_wall(38.0, 18.0, 130.0, 20000, cloud);
      expect_right_with_a_warning(cloud, 38.0, 27.0, leaning_plane(20.0), 0.2 + 1.5 * sigma_mm);
    }
  }
}

/// On which the body stands, so that both are one skin with a crease: normals that neighbours agree
/// on turned inwards somewhere, and no section closed.
TEST(GirthAboveAFloor, IsThatOfTheBody) {
  for (const double sigma_mm : {0.0, 0.3}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << sigma_mm << " " << seed);
      PointCloud cloud = body(43.0, 36.0, 3000, sigma_mm, seed);
      add_floor(25.0, 340.0, 13000, sigma_mm, cloud);
      expect_right_with_a_warning(cloud, 43.0, 36.0, leaning_plane(14.0), 0.5 + 1.5 * sigma_mm);
    }
  }
}

/// So near that a surface goes out to it and back: it is not what the tape lies on. Of 24 such
/// clouds two girths were 22 and 26 mm too long, and six were refused. Of 120 eight are off by more
/// than 1.5 intervals, none by more than three.
TEST(GirthBesideAWall, DoesNotGoOutToIt) {
  constexpr double kHardlyOutTo = 3.0;
  for (const double degrees : {10.0, 23.0}) {
    for (const std::size_t count : {6000U, 20000U}) {
      for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        SCOPED_TRACE(testing::Message() << degrees << " " << count << " " << seed);
        PointCloud cloud = body(52.0, 28.0, count, 0.36, seed);
        add_wall(52.0, 7.0, 200.0, 700, cloud);
        const auto plane = leaning_plane(degrees);
        const double truth = test::true_girth(test::elliptic_cylinder(52.0, 28.0), plane);
        const auto girth = girth_by_rbf(cloud, plane);
        ASSERT_TRUE(girth) << girth.error().line();
        EXPECT_NEAR(girth->contact_mm, truth, kHardlyOutTo * *girth->contact_u95_mm);
        EXPECT_NEAR(girth->stretched_mm, truth, kHardlyOutTo * *girth->stretched_u95_mm);
        EXPECT_LT(*girth->contact_u95_mm, 5.0);
      }
    }
  }
}

/// A strip that is hardly wider than the body that touches it closes with it, all corners. Of 60
/// such clouds 17 were told, 14 of these girths longer than their intervals allow by half and more.
TEST(GirthBesideAWall, IsNotSureRoundAStrip) {
  int missed = 0;
  for (const double apart_mm : {0.0, 1.0, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      PointCloud cloud = body(30.0, 33.0, 730, 0.3, seed);
      add_wall(30.0, apart_mm, 82.0, 300, cloud);
      std::erase_if(cloud.positions, [](const Eigen::Vector3d& position) {
        return position.x() < -30.0 && std::abs(position.y()) < 22.0;
      });
      const auto girth = girth_by_rbf(cloud, test::level_plane(0.0));
      if (!girth) continue;
      const double truth =
          test::true_girth(test::elliptic_cylinder(30.0, 33.0), test::level_plane(0.0));
      missed += std::abs(girth->stretched_mm - truth) > kThreeSigmas * *girth->stretched_u95_mm;
    }
  }
  EXPECT_LE(missed, 1);
}

/// Where the skin that faces the strip was not seen, what closes hangs on where patches are laid.
/// Of 36 such clouds 15 were told from one frame alone, 8 of these girths off by half more than
/// their intervals allow.
TEST(GirthBesideAWall, IsNotToldByTheChanceOfAFrame) {
  const auto shape = test::superellipse(30.0, 30.0, 3.0);
  const auto plane = test::level_plane(0.0);
  const double truth = test::true_girth(shape, plane);
  int missed = 0;
  for (const double apart_mm : {0.0, 2.0, 6.0}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      PointCloud cloud = test::random_points(shape, 700, -kHalfHeight, kHalfHeight, 0.0, seed);
      std::erase_if(cloud.positions,
                    [](const Eigen::Vector3d& position) { return position.x() < -26.0; });
      add_wall(30.0, apart_mm, 60.0, 280, cloud);
      const auto girth = girth_by_rbf(cloud, plane);
      if (!girth) continue;
      missed += std::abs(girth->stretched_mm - truth) > kThreeSigmas * *girth->stretched_u95_mm;
    }
  }
  EXPECT_LE(missed, 2);
}

/// A body with a gap that has to be bridged, and a clean pole: with a wall beside them both are
/// looked at alone, and the pole must not count because it is the surer.
TEST(GirthBesideAWall, IsNotThatOfASmallerBody) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    SCOPED_TRACE(testing::Message() << seed);
    PointCloud cloud = body(40.0, 40.0, 9000, 0.2, seed);
    std::erase_if(cloud.positions, [](const Eigen::Vector3d& position) {
      return position.x() > 0.0 && std::abs(position.y()) < 7.5;
    });
    PointCloud pole = body(12.0, 12.0, 4000, 0.0, seed);
    for (auto& position : pole.positions) position.y() += 70.0;
    cloud.append(pole);
    add_wall(40.0, 12.0, 200.0, 4000, cloud);
    const auto girth = girth_by_rbf(cloud, test::level_plane());
    EXPECT_NEAR(girth ? girth->stretched_mm : test::kCylinderGirth, test::kCylinderGirth, 10.0);
  }
}

/// Two feet are nearly as large as one another, and one is seen better.
TEST(GirthBesideAWall, IsThatOfTheLargerOfTwoBodies) {
  for (const double radius : {37.0, 38.5}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      SCOPED_TRACE(testing::Message() << radius << " " << seed);
      PointCloud cloud = body(40.0, 40.0, 9000, 0.2, seed);
      PointCloud other = body(radius, radius, 9000, 0.0, seed);
      for (auto& position : other.positions) position.y() += 110.0;
      cloud.append(other);
      add_wall(40.0, 20.0, 200.0, 6000, cloud);
      const auto girth = girth_by_rbf(cloud, test::level_plane());
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_NEAR(girth->stretched_mm, test::kCylinderGirth, 1.0);
    }
  }
}

/// Some of the strays hang together with the body in some ways to take it apart.
TEST(GirthBesideAWall, IsTheSameInAnyOrderOfPoints) {
  int told = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SCOPED_TRACE(testing::Message() << seed);
    PointCloud cloud = body(40.0, 40.0, 6000, 0.2, seed);
    RandomNumbers random(seed);
    for (int i = 0; i < 45; ++i) {
      cloud.positions.emplace_back(random.uniform(43.0, 58.0), random.uniform(-6.0, 6.0),
                                   random.uniform(-6.0, 6.0));
    }
    add_wall(40.0, 20.0, 180.0, 3000, cloud);
    const auto girth = girth_by_rbf(cloud, test::level_plane());
    std::reverse(cloud.positions.begin(), cloud.positions.end());
    const auto reversed = girth_by_rbf(cloud, test::level_plane());
    ASSERT_EQ(girth.has_value(), reversed.has_value());
    if (!girth) continue;
    ++told;
    EXPECT_NEAR(girth->contact_mm, reversed->contact_mm, 1e-9);
    EXPECT_NEAR(*girth->contact_u95_mm, *reversed->contact_u95_mm, 1e-9);
  }
  EXPECT_GT(told, 3);
}

}  // namespace
}  // namespace instep
