#include "core/surface/heights/tangent_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// Points of a slanted square sheet, one long, with noise along its normal.
std::vector<Vector3d> sheet(std::size_t count, double sigma) {
  test::RandomNumbers random(1);
  const Vector3d along(0.6, 0.0, 0.8);
  const Vector3d across(0.0, 1.0, 0.0);
  const Vector3d normal = along.cross(across);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-0.5, 0.5) * along + random.uniform(-0.5, 0.5) * across +
                        sigma * random.normal() * normal);
  }
  return points;
}

TEST(TangentView, SeesASheetFlat) {
  const auto points = sheet(10000, 0.0);
  const auto view = flattest_view(PointIndex(points), Vector3d::Zero());
  EXPECT_EQ(view.points.cols(), 60);
  EXPECT_LT(view.thickness, 1e-6);
  EXPECT_LT(view.points.row(2).cwiseAbs().maxCoeff(), 1e-9);
  // 60 of 10,000 points to a unit of area.
  EXPECT_NEAR(view.radius(), std::sqrt(0.006 / std::numbers::pi), 0.01);
  EXPECT_NEAR(view.spacing(), 0.01, 0.002);
  EXPECT_TRUE(view.crowded);
}

TEST(TangentView, IsWiderWhereNoiseIsThick) {
  const auto points = sheet(10000, 0.02);
  const auto view = flattest_view(PointIndex(points), Vector3d::Zero());
  EXPECT_EQ(view.points.cols(), 60);
  EXPECT_GT(view.radius(), 0.08);
  EXPECT_TRUE(view.crowded);
}

TEST(TangentView, IsNoCrowdWherePointsLieWideApart) {
  const auto points = sheet(1000, 0.0);
  EXPECT_FALSE(flattest_view(PointIndex(points), Vector3d::Zero()).crowded);
}

/// Both walls of a thin part looked like noise: of wedges of 500 exact points it was 2 mm.
TEST(TangentView, SeesOneWallOfAThinPart) {
  test::RandomNumbers random(2);
  std::vector<Vector3d> walls;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(0.1, 0.5);
    const double z = random.uniform(-0.2, 0.2);
    walls.emplace_back(x, (i % 2 == 0 ? 0.2 : -0.2) * (0.5 - x), z);
  }
  for (const std::size_t i : {0U, 1U, 2U, 3U}) {
    const auto view = flattest_view(PointIndex(walls), walls[i]);
    EXPECT_LT(view.thickness, 1e-6) << i;
    EXPECT_GE(view.points.cols(), 6) << i;
  }
}

}  // namespace
}  // namespace instep
