#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::cylinder;
using test::level_plane;
using test::plane_at;

void expect_refusal(const PointCloud& cloud, const TapePlane& plane) {
  const auto girth = girth_by_rbf(cloud, plane);
  ASSERT_FALSE(girth) << girth->contact_mm;
  EXPECT_FALSE(girth.error().message.empty());
  EXPECT_FALSE(girth.error().advice.empty());
}

TEST(GirthByRbf, RefusesALineThroughThePlane) {
  PointCloud cloud;
  for (int i = -500; i <= 500; ++i) cloud.positions.emplace_back(0.0, 0.0, 0.05 * i);
  const auto girth = girth_by_rbf(cloud, level_plane());
  ASSERT_FALSE(girth);
  EXPECT_EQ(girth.error().code, ErrorCode::kInsufficientData);
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
