#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::level_plane;
using test::rings;

double polygon_girth(int corners) {
  return 2.0 * corners * 40 * std::sin(std::numbers::pi / corners);
}

TEST(GirthByHull, IsThatOfThePolygonOfARing) {
  for (const int corners : {120, 60, 30}) {
    const auto girth = girth_by_hull(rings(corners, 10, 3.0), level_plane(13.1));
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, polygon_girth(corners), 1e-9);
    EXPECT_EQ(girth->contact_mm, girth->stretched_mm);
    EXPECT_FALSE(girth->stretched_u95_mm);
    EXPECT_NEAR(girth->largest_gap_mm, polygon_girth(corners) / corners, 1e-9);
  }
}

TEST(GirthByHull, TellsTheStretchThatNoCameraSaw) {
  PointCloud cloud = rings(120, 10, 3.0);
  for (const auto& position : cloud.positions) {
    cloud.origins.push_back(position.x() < 0.1 ? PointOrigin::kPlatform : PointOrigin::kSeen);
  }
  const auto girth = girth_by_hull(cloud, level_plane(13.1));
  ASSERT_TRUE(girth);
  EXPECT_NEAR(girth->largest_gap_mm, 40 * std::numbers::pi, 5.0);
}

TEST(GirthByHull, IsNotMovedByCopies) {
  auto cloud = rings(60, 10, 3.0);
  const auto once = girth_by_hull(cloud, level_plane(13.1));
  const auto positions = cloud.positions;
  cloud.positions.insert(cloud.positions.end(), positions.begin(), positions.end());
  const auto twice = girth_by_hull(cloud, level_plane(13.1));
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(twice->stretched_mm, once->stretched_mm);
}

TEST(GirthByHull, DoesNotDependOnWhereTheBodyStands) {
  const auto cloud = test::random_points(test::elliptic_cylinder(45, 28), 20000, -30, 30, 0.1, 3);
  RigidTransform moved = RigidTransform::Identity();
  moved.rotate(Eigen::AngleAxisd(0.8, Eigen::Vector3d(2, 1, -0.5).normalized()));
  moved.pretranslate(Eigen::Vector3d(70, -80, 300));
  const auto here = girth_by_hull(cloud, test::oblique_plane());
  const auto there =
      girth_by_hull(transformed(moved, cloud), test::oblique_plane().transformed(moved));
  ASSERT_TRUE(here && there);
  EXPECT_EQ(there->band_points, here->band_points);
  EXPECT_NEAR(there->stretched_mm, here->stretched_mm, 1e-9);
  EXPECT_NEAR(there->largest_gap_mm, here->largest_gap_mm, 1e-9);
}

/// A gap is told by all corners of the hull; asking each of them for each point took minutes.
TEST(GirthByHull, TellsAGapOfManyPointsInThePlane) {
  constexpr std::size_t kPoints = 200000;
  PointCloud cloud;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double angle = (2.0 * std::numbers::pi - 0.5) * static_cast<double>(i) / (kPoints - 1);
    cloud.positions.emplace_back(40.0 * std::cos(angle), 40.0 * std::sin(angle),
                                 i % 2 == 0 ? 1e-3 : -1e-3);
  }
  const auto girth = girth_by_hull(cloud, level_plane(0.0));
  ASSERT_TRUE(girth) << girth.error().line();
  const double chord = 2.0 * 40.0 * std::sin(0.25);
  EXPECT_NEAR(girth->largest_gap_mm, chord, 1e-3);
  EXPECT_NEAR(girth->stretched_mm, 40.0 * (2.0 * std::numbers::pi - 0.5) + chord, 1e-3);
}

TEST(GirthByHull, RefusesWhatHoldsNoRing) {
  EXPECT_FALSE(girth_by_hull({}, level_plane(0)));
  EXPECT_FALSE(girth_by_hull(rings(60, 10, 3.0), level_plane(200)));
  PointCloud equal;
  equal.positions.assign(100, Vector3d(1, 2, 3));
  EXPECT_FALSE(girth_by_hull(equal, level_plane(3)));
  PointCloud line;
  for (int i = 0; i < 100; ++i) line.positions.emplace_back(i, 2.0 * i, 3);
  EXPECT_FALSE(girth_by_hull(line, level_plane(3)));
}

}  // namespace
}  // namespace instep
