#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
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
using test::plane_at;

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

TEST(GirthByRbf, DoesNotDependOnWhereTheBodyStands) {
  const auto cloud = test::random_points(test::elliptic_cylinder(45, 30), 3000, -30, 30, 0.2, 9);
  RigidTransform moved_from_here = RigidTransform::Identity();
  moved_from_here.rotate(Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()));
  moved_from_here.pretranslate(Vector3d(812, -333, 95));
  const auto here = girth_by_rbf(cloud, oblique_plane());
  const auto there = girth_by_rbf(transformed(moved_from_here, cloud),
                                  oblique_plane().transformed(moved_from_here));
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(there->contact_mm, here->contact_mm, 1e-3);
  EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-3);
}

TEST(GirthByRbf, ScalesWithTheUnit) {
  const auto cloud = cylinder(2000, 0.2);
  const auto plane = oblique_plane();
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_TRUE(girth);
  for (const double scale : {1e-3, 1e3}) {
    PointCloud scaled = cloud;
    for (auto& position : scaled.positions) position *= scale;
    const auto& c = plane.control_points();
    const auto other = girth_by_rbf(scaled, plane_at(scale * c[0], scale * c[1], scale * c[2]));
    ASSERT_TRUE(other) << other.error().line();
    EXPECT_NEAR(other->contact_mm / scale, girth->contact_mm, 1e-6);
    EXPECT_NEAR(other->stretched_mm / scale, girth->stretched_mm, 1e-6);
    EXPECT_NEAR(other->sigma_mm / scale, girth->sigma_mm, 1e-6);
  }
}

TEST(GirthByRbf, DoesNotDependOnTheOrderOfThePoints) {
  auto cloud = cylinder(3000, 0.2);
  const auto girth = girth_by_rbf(cloud, oblique_plane());
  std::reverse(cloud.positions.begin(), cloud.positions.end());
  const auto reversed = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(girth && reversed);
  EXPECT_NEAR(reversed->contact_mm, girth->contact_mm, 1e-9);
  EXPECT_NEAR(reversed->stretched_mm, girth->stretched_mm, 1e-9);
}

TEST(GirthByRbf, GivesTheSameBytesTwice) {
  const auto cloud = cylinder(3000, 0.3);
  const auto first = girth_by_rbf(cloud, oblique_plane());
  const auto second = girth_by_rbf(cloud, oblique_plane());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->contact_mm, second->contact_mm);
  EXPECT_EQ(first->contour, second->contour);
}

/// A box whose points stand in a lattice, 1.5 mm apart, and a plane through it, `scale` times as
/// large.
struct LatticeBox {
  PointCloud cloud;
  TapePlane plane;
};

LatticeBox lattice_box(double scale) {
  PointCloud cloud;
  for (const auto& point : test::prism_points(60.0, 80.0, 1.5, 0.0, 1)) {
    cloud.positions.push_back(scale * point.position);
  }
  const Vector3d first(30, 0, 3.4);
  const Vector3d second(0, 30, 0.4);
  const Vector3d third(-30, -10, -2.6);
  return {std::move(cloud),
          TapePlane::through(scale * first, scale * second, scale * third).value()};
}

/// Which of the points that are equally far are among the nearest, rounding decided: girths of one
/// box were up to 0.1 mm apart.
TEST(GirthByRbf, OfALatticeDoesNotDependOnWhereItLies) {
  const LatticeBox box = lattice_box(1.0);
  const auto here = girth_by_rbf(box.cloud, box.plane);
  ASSERT_TRUE(here) << here.error().line();
  for (int turn = 1; turn <= 5; ++turn) {
    RigidTransform away = RigidTransform::Identity();
    away.rotate(Eigen::AngleAxisd(0.7 * turn, Vector3d(0.3 * turn, 1, -0.2).normalized()));
    away.pretranslate(Vector3d(11.3 * turn, -77, 31 * turn));
    const auto there = girth_by_rbf(transformed(away, box.cloud), box.plane.transformed(away));
    ASSERT_TRUE(there) << there.error().line();
    EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-9) << turn;
    EXPECT_NEAR(there->contact_mm, here->contact_mm, 1e-9) << turn;
    EXPECT_NEAR(*there->contact_u95_mm, *here->contact_u95_mm, 1e-8) << turn;
  }
}

TEST(GirthByRbf, OfALatticeDoesNotDependOnItsUnit) {
  const LatticeBox box = lattice_box(1.0);
  const auto here = girth_by_rbf(box.cloud, box.plane);
  ASSERT_TRUE(here) << here.error().line();
  for (const double scale : {10.0, 25.4, 0.1, 1000.0, 1.0 / 3.0}) {
    const LatticeBox scaled = lattice_box(scale);
    const auto there = girth_by_rbf(scaled.cloud, scaled.plane);
    ASSERT_TRUE(there) << there.error().line();
    EXPECT_NEAR(there->stretched_mm / scale, here->stretched_mm, 1e-9) << scale;
    EXPECT_NEAR(there->contact_mm / scale, here->contact_mm, 1e-9) << scale;
    EXPECT_NEAR(*there->contact_u95_mm / scale, *here->contact_u95_mm, 1e-8) << scale;
  }
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

TEST(GirthByRbf, RefusesALineThroughThePlane) {
  PointCloud cloud;
  for (int i = -500; i <= 500; ++i) cloud.positions.emplace_back(0.0, 0.0, 0.05 * i);
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_FALSE(girth);
  EXPECT_EQ(girth.error().code, ErrorCode::kInsufficientData);
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

void expect_refusal(const PointCloud& cloud, const TapePlane& plane) {
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_FALSE(girth) << girth->contact_mm;
  EXPECT_FALSE(girth.error().message.empty());
  EXPECT_FALSE(girth.error().advice.empty());
}

TEST(GirthByRbf, RefusesTooLittle) {
  expect_refusal({}, level_plane());
  PointCloud three;
  three.positions = {{1, 0, 0}, {0, 1, 3}, {-1, 0, 0}};
  expect_refusal(three, level_plane());
}

TEST(GirthByRbf, RefusesPointsThatFormNoSurface) {
  PointCloud equal;
  equal.positions.assign(500, Vector3d(3, 4, 1.3));
  expect_refusal(equal, level_plane());
  PointCloud line;
  for (int i = 0; i < 500; ++i) line.positions.emplace_back(0.2 * i, 0.1 * i, -20 + 0.1 * i);
  expect_refusal(line, level_plane());
}

TEST(GirthByRbf, RefusesAFlatCloud) {
  PointCloud across, within;
  test::RandomNumbers random(8);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.uniform(-50, 50);
    const double b = random.uniform(-50, 50);
    across.positions.emplace_back(a, 0.0, b);
    within.positions.emplace_back(a, b, 1.3);
  }
  expect_refusal(across, level_plane());
  expect_refusal(within, level_plane());
}

TEST(GirthByRbf, RefusesAPlaneThatMissesOrGrazesTheBody) {
  expect_refusal(cylinder(3000), plane_at({0, 0, 80}, {1, 0, 80}, {0, 1, 80}));
  expect_refusal(cylinder(3000), plane_at({40, 0, 0}, {40, 1, 0}, {40, 0, 1}));
  expect_refusal(cylinder(3000), plane_at({0, 0, 30}, {1, 0, 30}, {0, 1, 30}));
}

TEST(GirthByRbf, RefusesASectionThatIsOpen) {
  PointCloud cloud = cylinder(6000);
  std::erase_if(cloud.positions, [](const auto& p) { return p.y() < 0.0; });
  expect_refusal(cloud, level_plane());
}

TEST(GirthByRbf, RefusesWhatIsNoNumber) {
  PointCloud cloud = cylinder(3000);
  cloud.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(cloud, level_plane());
}

TEST(GirthByRbf, SurvivesPointsSpreadThroughAVolume) {
  PointCloud cloud;
  test::RandomNumbers random(12);
  for (int i = 0; i < 5000; ++i) {
    cloud.positions.emplace_back(random.uniform(-40, 40), random.uniform(-40, 40),
                                 random.uniform(-40, 40));
  }
  const auto girth = girth_by_rbf(cloud, level_plane());
  EXPECT_TRUE(!girth || std::isfinite(girth->contact_mm));
}

TEST(GirthByRbf, SurvivesTwoShellsInEachOther) {
  PointCloud cloud = cylinder(4000);
  cloud.append(test::random_points(test::elliptic_cylinder(37, 37), 4000, -30, 30, 0.0, 6));
  const auto girth = girth_by_rbf(cloud, level_plane());
  if (girth) {
    EXPECT_GT(girth->stretched_mm, 74 * M_PI - 1);
    EXPECT_LT(girth->stretched_mm, 80 * M_PI + 1);
  }
}

}  // namespace
}  // namespace instep
