#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/girth/girth.h"
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
