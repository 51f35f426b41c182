#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::AnalyticShape;
using test::cylinder;
using test::kCylinderGirth;
using test::level_plane;
using test::oblique_plane;
using test::rings;

bool warns(const Girth& girth, const std::string& words) {
  return std::any_of(girth.warnings.begin(), girth.warnings.end(), [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

/// How much too short the girth of a convex shape is; chords can only cut off.
double shortfall(const AnalyticShape& shape, const TapePlane& plane, std::size_t count) {
  const auto girth = girth_by_mesh(test::random_points(shape, count, -30, 30, 0.0, 11), plane);
  if (!girth) ADD_FAILURE() << girth.error().line();
  if (!girth) return 1e9;
  EXPECT_TRUE(girth->warnings.empty());
  EXPECT_LE(girth->stretched_mm, girth->contact_mm);
  EXPECT_FALSE(girth->stretched_u95_mm);
  const double missing = test::true_girth(shape, plane) - girth->stretched_mm;
  EXPECT_GT(missing, 0.0);
  return missing;
}

// Between aligned rings the triangles lie in the sides of a prism, whichever way their diagonals
// run.
TEST(GirthByMesh, IsThatOfThePrismOfAlignedRings) {
  for (const int corners : {120, 60, 30}) {
    for (const double height : {13.1, 15.0}) {
      const auto girth = girth_by_mesh(rings(corners, 10, 3.0), level_plane(height));
      ASSERT_TRUE(girth) << girth.error().line();
      const double polygon = 2.0 * corners * 40 * std::sin(std::numbers::pi / corners);
      EXPECT_NEAR(girth->stretched_mm, polygon, 1e-9);
      EXPECT_NEAR(girth->contact_mm, polygon, 1e-9);
      EXPECT_NEAR(girth->largest_gap_mm, polygon / corners, 1e-9);
      EXPECT_EQ(girth->points, 10U * static_cast<std::size_t>(corners));
    }
  }
}

// Measured on these: 0.48 to 1.69 mm from 450 points, 0.028 to 0.075 mm from 8000.
TEST(GirthByMesh, FallsShortOfSmoothShapesByTheirChords) {
  const std::vector<AnalyticShape> shapes = {
      test::elliptic_cylinder(40, 40), test::elliptic_cylinder(45, 28), test::cone(38, 0.3),
      test::ellipsoid(42, 42, 42),     test::ellipsoid(50, 35, 60),     test::bent_tube(90, 35)};
  for (const auto& plane : {level_plane(1.3), oblique_plane()}) {
    for (const auto& shape : shapes) {
      const double sparse = shortfall(shape, plane, 450);
      const double dense = shortfall(shape, plane, 8000);
      EXPECT_LT(sparse, 2.0);
      EXPECT_LT(dense, 0.1);
      EXPECT_GT(sparse / dense, 5.0) << "18 times the points, so about 18 times as near";
    }
  }
}

TEST(GirthByMesh, FollowsTheSkinIntoHollows) {
  const AnalyticShape waisted = {
      [](double angle, double height) {
        const double radius = 40 + 16 * std::cos(2 * angle);
        return Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
      },
      [](const Vector3d& p) {
        return p.head<2>().norm() - 40 - 16 * std::cos(2 * std::atan2(p.y(), p.x()));
      }};
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < 20000; ++i) {
    section.push_back(waisted.at(2 * std::numbers::pi * i / 20000, 0).head<2>());
  }
  const auto girth =
      girth_by_mesh(test::random_points(waisted, 8000, -30, 30, 0, 3), level_plane(1.3));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->contact_mm, perimeter(section), 0.1);
  EXPECT_NEAR(girth->stretched_mm, perimeter(convex_hull(section)), 0.1);
  EXPECT_GT(girth->contact_mm - girth->stretched_mm, 1.0);
}

TEST(GirthByMesh, UsesNoNormals) {
  auto cloud = cylinder(2000);
  const auto without = girth_by_mesh(cloud, level_plane(1.3));
  cloud.normals.assign(cloud.size(), Vector3d::UnitX());
  const auto with = girth_by_mesh(cloud, level_plane(1.3));
  ASSERT_TRUE(without && with);
  EXPECT_EQ(with->stretched_mm, without->stretched_mm);
}

TEST(GirthByMesh, IsTheSameInAnyUnit) {
  const auto girth = girth_by_mesh(cylinder(2000), level_plane(1.3));
  auto metres = cylinder(2000);
  for (auto& position : metres.positions) position *= 1e-3;
  const auto small = girth_by_mesh(metres, level_plane(1.3e-3));
  ASSERT_TRUE(girth && small);
  EXPECT_NEAR(1e3 * small->stretched_mm, girth->stretched_mm, 1e-9);
}

TEST(GirthByMesh, BearsDuplicatesAndStrays) {
  auto cloud = cylinder(4000);
  cloud.append(cylinder(4000));
  test::RandomNumbers random(3);
  for (int i = 0; i < 120; ++i) {
    cloud.positions.emplace_back(random.uniform(-60, 60), random.uniform(-60, 60),
                                 random.uniform(-30, 30));
  }
  const auto girth = girth_by_mesh(cloud, level_plane(1.3));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, kCylinderGirth, 0.1);
}

TEST(GirthByMesh, MeasuresTheLargerOfTwoBodiesAndNamesTheOther) {
  auto cloud = cylinder(4000);
  for (const auto& p :
       test::random_points(test::elliptic_cylinder(20, 20), 2000, -30, 30, 0, 6).positions) {
    cloud.positions.push_back(p + Vector3d(66, 0, 0));
  }
  const auto girth = girth_by_mesh(cloud, level_plane(1.3));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, kCylinderGirth, 0.1);
  ASSERT_EQ(girth->warnings.size(), 1U);
  EXPECT_TRUE(warns(*girth, "closed loop, 125.")) << girth->warnings.front();
}

PointCloud without_arc(double half_angle) {
  PointCloud cloud;
  for (const auto& position : cylinder(6000).positions) {
    if (std::abs(std::atan2(position.y(), position.x())) > half_angle) {
      cloud.positions.push_back(position);
    }
  }
  return cloud;
}

// The bridge is a straight line between points at most a spacing or two from the rims.
TEST(GirthByMesh, BridgesAHoleAndTellsItsWidth) {
  const double half_angle = 0.35;
  const auto girth = girth_by_mesh(without_arc(half_angle), level_plane(1.3));
  ASSERT_TRUE(girth) << girth.error().line();
  const double chord = 80 * std::sin(half_angle);
  EXPECT_GT(girth->largest_gap_mm, chord);
  EXPECT_LT(girth->largest_gap_mm, chord + 3.0);
  EXPECT_NEAR(girth->stretched_mm, kCylinderGirth - (80 * half_angle - chord), 0.3);
  EXPECT_TRUE(warns(*girth, "bridged"));
}

TEST(GirthByMesh, RefusesWhatIsOpenByMoreThanAQuarter) {
  const auto girth = girth_by_mesh(without_arc(1.3), level_plane(1.3));
  ASSERT_FALSE(girth);
  EXPECT_EQ(girth.error().code, ErrorCode::kInsufficientData);
}

TEST(GirthByMesh, CountsUnseenPointsAsAGap) {
  auto cloud = cylinder(6000);
  for (const auto& position : cloud.positions) {
    const bool seen = std::abs(std::atan2(position.y(), position.x())) > 0.35;
    cloud.origins.push_back(seen ? PointOrigin::kSeen : PointOrigin::kPlatform);
  }
  const auto girth = girth_by_mesh(cloud, level_plane(1.3));
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_NEAR(girth->stretched_mm, kCylinderGirth, 0.1);
  EXPECT_NEAR(girth->largest_gap_mm, 28.0, 3.0);
}

TEST(GirthByMesh, WarnsThatItFollowsNoise) {
  const auto clean = girth_by_mesh(cylinder(8000), level_plane(1.3));
  const auto noisy = girth_by_mesh(cylinder(8000, 0.3), level_plane(1.3));
  ASSERT_TRUE(clean && noisy);
  EXPECT_FALSE(warns(*clean, "noise"));
  EXPECT_TRUE(warns(*noisy, "noise"));
  EXPECT_GT(noisy->stretched_mm, kCylinderGirth + 0.5);
  EXPECT_GT(noisy->contact_mm, noisy->stretched_mm + 2.0);
}

/// Lines that are averaged, by what is told of all points, not by what the cloud tells of each.
TEST(GirthByMesh, HeedsTheNoiseThatIsToldInPlaceOfTheClouds) {
  const test::ScannedLines lines{42, 30, true, 6.0, 0.15, 0.1};
  PointCloud plain;
  plain.positions = lines.positions(1);
  PointCloud telling = plain;
  test::RandomNumbers random(2);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    telling.sigma_mm.push_back(random.uniform(0.01, 3.0));
  }
  const GirthOptions told{.sigma_mm = 0.1};
  const auto expected = girth_by_mesh(plain, level_plane(), told);
  const auto girth = girth_by_mesh(telling, level_plane(), told);
  const auto weighed = girth_by_mesh(telling, level_plane());
  ASSERT_TRUE(expected && girth && weighed);
  EXPECT_EQ(girth->contact_mm, expected->contact_mm);
  EXPECT_NE(weighed->contact_mm, expected->contact_mm);
}

TEST(GirthByMesh, RefusesWhatHoldsNoSurface) {
  EXPECT_FALSE(girth_by_mesh({}, level_plane(0)));
  PointCloud few;
  few.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(girth_by_mesh(few, level_plane(0)));
  EXPECT_FALSE(girth_by_mesh(cylinder(2000), level_plane(200)));
  PointCloud equal;
  equal.positions.assign(500, Vector3d(1, 2, 3));
  EXPECT_FALSE(girth_by_mesh(equal, level_plane(3)));
  PointCloud line;
  for (int i = 0; i < 500; ++i) line.positions.emplace_back(i, 2.0 * i, i - 250);
  EXPECT_FALSE(girth_by_mesh(line, level_plane(3)));
  PointCloud sheet;
  for (int i = 0; i < 900; ++i) sheet.positions.emplace_back(i % 30, 0, i / 30);
  EXPECT_FALSE(girth_by_mesh(sheet, level_plane(15.5)));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e30}) {
    auto broken = cylinder(2000);
    broken.positions[7].y() = bad;
    EXPECT_FALSE(girth_by_mesh(broken, level_plane(1.3)));
  }
}

TEST(GirthByMesh, RefusesACrowdWithoutASurface) {
  test::RandomNumbers random(1);
  PointCloud crowd;
  for (int i = 0; i < 20000; ++i) {
    crowd.positions.emplace_back(random.uniform(-50, 50), random.uniform(-50, 50),
                                 random.uniform(-50, 50));
  }
  const auto girth = girth_by_mesh(crowd, level_plane(0.3));
  ASSERT_FALSE(girth);
  EXPECT_EQ(girth.error().code, ErrorCode::kInsufficientData);
}

/// Two cones that meet in one point of the plane: the mesh was cut there and nowhere else, and the
/// girth was nought.
TEST(GirthByMesh, RefusesASectionWithoutExtent) {
  PointCloud cloud;
  cloud.positions.emplace_back(0, 0, 0);
  for (int row = 1; row <= 10; ++row) {
    const int count = 6 * row;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      for (const double side : {-1.0, 1.0}) {
        cloud.positions.emplace_back(3.0 * row * std::cos(angle), 3.0 * row * std::sin(angle),
                                     6.0 * side * row);
      }
    }
  }
  const auto girth = girth_by_mesh(cloud, level_plane(0));
  ASSERT_FALSE(girth);
  EXPECT_EQ(girth.error().code, ErrorCode::kInsufficientData);
}

}  // namespace
}  // namespace instep
