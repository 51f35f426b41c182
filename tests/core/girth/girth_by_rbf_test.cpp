#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::AnalyticShape;
using test::cylinder;
using test::level_plane;
using test::oblique_plane;

void expect_girth(const AnalyticShape& shape, const TapePlane& plane, std::size_t count,
                  double tolerance_mm) {
  const auto cloud = test::random_points(shape, count, -30, 30, 0.0, 11);
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, test::true_girth(shape, plane), tolerance_mm);
  EXPECT_NEAR(girth->stretched_mm, girth->contact_mm, tolerance_mm);
}

TEST(GirthByRbf, MeetsSmoothShapesFromDensePoints) {
  expect_girth(test::elliptic_cylinder(40, 40), level_plane(), 6000, 0.002);
  expect_girth(test::elliptic_cylinder(45, 28), oblique_plane(), 6000, 0.002);
  expect_girth(test::cone(38, 0.3), oblique_plane(), 6000, 0.002);
  expect_girth(test::ellipsoid(42, 42, 42), level_plane(), 6000, 0.002);
  expect_girth(test::ellipsoid(50, 35, 60), oblique_plane(), 6000, 0.002);
  expect_girth(test::bent_tube(90, 35), oblique_plane(), 6000, 0.002);
}

TEST(GirthByRbf, MeetsSmoothShapesFromFewPoints) {
  expect_girth(test::elliptic_cylinder(40, 40), level_plane(), 450, 0.06);
  expect_girth(test::elliptic_cylinder(45, 28), oblique_plane(), 450, 0.06);
  expect_girth(test::cone(38, 0.3), oblique_plane(), 450, 0.06);
  expect_girth(test::superellipse(42, 38, 3.0), level_plane(), 1200, 0.06);
  expect_girth(test::bent_tube(90, 35), oblique_plane(), 450, 0.06);
}

TEST(GirthByRbf, AveragesNoiseInsteadOfFollowingIt) {
  const auto shape = test::elliptic_cylinder(45, 30);
  for (const double sigma : {0.1, 0.3, 0.5}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      const auto cloud = test::random_points(shape, 8000, -30, 30, sigma, seed);
      const auto girth = girth_by_rbf(cloud, oblique_plane());
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_NEAR(girth->stretched_mm, test::true_girth(shape, oblique_plane()), 0.6 * sigma)
          << "sigma " << sigma << " seed " << seed;
      EXPECT_NEAR(girth->sigma_mm, sigma, 0.15 * sigma);
    }
  }
}

TEST(GirthByRbf, StretchesOverHollowsAndTouchesThem) {
  const AnalyticShape lobed{
      [](double angle, double height) {
        const double radius = 40 + 8 * std::cos(3 * angle);
        return Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
      },
      [](const Vector3d& p) {
        return p.head<2>().norm() - 40 - 8 * std::cos(3 * std::atan2(p.y(), p.x()));
      }};
  const auto girth = girth_by_rbf(test::random_points(lobed, 6000, -30, 30, 0.0, 3), level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, test::true_girth(lobed, level_plane()), 0.01);
  EXPECT_LT(girth->stretched_mm, girth->contact_mm - 0.5);
}

TEST(GirthByRbf, ATapeIsNoLongerThanTheSkinItGoesRound) {
  const auto shape = test::elliptic_cylinder(45, 30);
  for (const double sigma : {0.0, 0.2}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto cloud = test::random_points(shape, 600, -30, 30, sigma, seed);
      const auto girth = girth_by_rbf(cloud, oblique_plane());
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_LE(girth->stretched_mm, girth->contact_mm) << sigma << " " << seed;
    }
  }
}

TEST(GirthByRbf, BridgesAHoleAndTellsItsWidth) {
  PointCloud cloud = cylinder(6000);
  const Vector3d centre(40, 0, 1);
  std::erase_if(cloud.positions, [&](const auto& p) { return (p - centre).norm() < 10.0; });
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 80 * M_PI, 0.05);
  EXPECT_NEAR(girth->largest_gap_mm, 20.0, 2.5);
  EXPECT_FALSE(girth->warnings.empty());
}

TEST(GirthByRbf, CountsPlatformPointsAsShapeButNotAsEvidence) {
  PointCloud cloud = cylinder(6000);
  for (const auto& position : cloud.positions) {
    cloud.origins.push_back(position.x() < -30 ? PointOrigin::kPlatform : PointOrigin::kSeen);
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 80 * M_PI, 0.01);
  EXPECT_NEAR(girth->largest_gap_mm, 2 * 40 * std::acos(30.0 / 40.0), 3.0);
}

/// A foot's section, 80 mm wide: a flat sole of platform points, a seen dome from 40 mm up the
/// sides, and between them a rounded rim of `radius` that nothing saw.
PointCloud foot_without_rim(double radius, std::uint64_t seed) {
  PointCloud cloud;
  test::RandomNumbers random(seed);
  const auto add = [&](const Vector3d& position, const Vector3d& normal, double sigma,
                       PointOrigin origin) {
    cloud.positions.push_back(position);
    cloud.normals.push_back(normal);
    cloud.sigma_mm.push_back(sigma);
    cloud.origins.push_back(origin);
  };
  for (int i = 0; i < 7000; ++i) {
    const double angle = random.uniform(0, M_PI);
    const Vector3d place(40 * std::cos(angle), 50 * std::sin(angle), 0);
    const Vector3d normal = Vector3d(place.x() / 1600, place.y() / 2500, 0).normalized();
    add(place + Vector3d(0, radius, random.uniform(-30, 30)) + 0.07 * random.normal() * normal,
        normal, 0.07, PointOrigin::kSeen);
  }
  for (double x = radius - 40; x <= 40 - radius; x += 1.0) {
    for (double z = -30; z <= 30; z += 1.0) {
      add({x, 0, z}, {0, -1, 0}, 0.5, PointOrigin::kPlatform);
    }
  }
  return cloud;
}

TEST(GirthByRbf, BridgesAWideUnseenRimWithoutOvershoot) {
  const double radius = 5.0;
  const double dome = 0.5 * test::true_girth(test::elliptic_cylinder(40, 50), level_plane());
  const double truth = dome + 2 * (40 - radius) + M_PI * radius;
  const double chords = dome + 2 * (40 - radius) + 2 * M_SQRT2 * radius;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto girth = girth_by_rbf(foot_without_rim(radius, seed), level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    double overshoot = 0.0;
    for (const auto& place : girth->contour) {
      overshoot = std::max({overshoot, std::abs(place.x()) - 40, -place.y()});
    }
    EXPECT_LT(overshoot, 0.2) << "seed " << seed;
    // No tape is longer than the round rim, none shorter than a straight line across it.
    EXPECT_LT(girth->stretched_mm, truth + 0.3) << "seed " << seed;
    EXPECT_GT(girth->stretched_mm, chords - 0.3) << "seed " << seed;
  }
}

TEST(GirthByRbf, UsesTheNormalsAndTheNoiseOfTheCloud) {
  PointCloud cloud = cylinder(3000, 0.3);
  for (const auto& position : cloud.positions) {
    cloud.normals.push_back(Vector3d(position.x(), position.y(), 0).normalized());
    cloud.sigma_mm.push_back(0.3);
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_DOUBLE_EQ(girth->sigma_mm, 0.3);
  EXPECT_NEAR(girth->contact_mm, 80 * M_PI, 0.3);
}

TEST(GirthByRbf, OrientsByTheViewIfThereIsOne) {
  PointCloud cloud = cylinder(3000);
  for (const auto& position : cloud.positions) {
    cloud.view_directions.push_back(Vector3d(position.x(), position.y(), 15).normalized());
  }
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, test::true_girth(test::elliptic_cylinder(40, 40), oblique_plane()),
              0.01);
}

TEST(GirthByRbf, IsNotMovedByDuplicates) {
  auto cloud = cylinder(2000);
  const auto once = cloud.positions;
  for (const auto& position : once) {
    cloud.positions.push_back(position);
    cloud.positions.push_back(position + Vector3d(1e-7, 0, 1e-7));
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 80 * M_PI, 0.01);
}

TEST(GirthByRbf, IsNotMovedByACrowdAtOnePlace) {
  auto cloud = cylinder(2000);
  const auto alone = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(alone) << alone.error().line();
  cloud.positions.resize(100000, cloud.positions.front());
  const auto crowded = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(crowded) << crowded.error().line();
  EXPECT_EQ(crowded->contact_mm, alone->contact_mm);
}

TEST(GirthByRbf, ChoosesTheLargerOfTwoBodiesAndNamesTheOther) {
  PointCloud cloud = test::random_points(test::elliptic_cylinder(30, 30), 4000, -30, 30, 0.0, 1);
  const auto other = test::random_points(test::elliptic_cylinder(20, 20), 3000, -30, 30, 0.0, 2);
  for (const auto& position : other.positions) {
    cloud.positions.push_back(position + Vector3d(90, 0, 0));
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, 60 * M_PI, 0.01);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_NE(girth->warnings.front().find("125.7"), std::string::npos) << girth->warnings.front();
}

/// A cloud merged with itself: noise that is the same in two points looks like an exact surface.
TEST(GirthByRbf, TakesNearCopiesForOnePoint) {
  for (const double apart : {1e-4, 1e-2, 0.1}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      PointCloud cloud = cylinder(3000, 0.3, seed);
      test::RandomNumbers random(seed);
      for (std::size_t i = 0; i < 3000; ++i) {
        const Eigen::Vector3d aside(random.normal(), random.normal(), random.normal());
        cloud.positions.emplace_back(cloud.positions[i] + apart * aside);
      }
      const auto girth = girth_by_rbf(cloud, level_plane());
      ASSERT_TRUE(girth) << girth.error().line();
      EXPECT_NEAR(girth->contact_mm, test::kCylinderGirth, 0.3) << apart << " mm, seed " << seed;
    }
  }
}

TEST(GirthByRbf, RunsThroughTheMiddleOfAThickShell) {
  PointCloud cloud;
  test::RandomNumbers random(7);
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.uniform(0, 2 * M_PI);
    const double radius = random.uniform(45, 50);
    cloud.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 random.uniform(-30, 30));
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, 95 * M_PI, 1.0);
  EXPECT_NEAR(girth->contact_mm, 95 * M_PI, 1.0);
}

}  // namespace
}  // namespace instep
