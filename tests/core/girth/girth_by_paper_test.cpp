#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::AnalyticShape;
using test::level_plane;
using test::oblique_plane;
using test::plane_at;

PointCloud cloud_of(const AnalyticShape& shape, std::size_t count, std::uint64_t seed = 11) {
  return test::random_points(shape, count, -30, 30, 0.0, seed);
}

void expect_girth(const AnalyticShape& shape, const TapePlane& plane) {
  const auto girth = girth_by_paper(cloud_of(shape, 6000), plane);
  ASSERT_TRUE(girth) << girth.error().line();
  const double truth = test::true_girth(shape, plane);
  EXPECT_NEAR(girth->stretched_mm, truth, 0.3);
  EXPECT_NEAR(girth->contact_mm, truth, 2.5);
  EXPECT_FALSE(girth->stretched_u95_mm);
  EXPECT_EQ(girth->points, 6000U);
  EXPECT_GT(girth->band_points, 300U);
}

TEST(GirthByPaper, MeetsSmoothShapesFromDensePoints) {
  expect_girth(test::elliptic_cylinder(40, 40), level_plane());
  expect_girth(test::elliptic_cylinder(45, 28), oblique_plane());
  expect_girth(test::cone(38, 0.3), oblique_plane());
  expect_girth(test::ellipsoid(50, 35, 60), oblique_plane());
  expect_girth(test::bent_tube(90, 35), oblique_plane());
}

TEST(GirthByPaper, MeetsAGridOfPointsWithinAMillimetre) {
  for (const auto& [per_ring, count] : {std::pair{120, 10}, {60, 15}, {30, 15}}) {
    const auto girth =
        girth_by_paper(test::rings(per_ring, count, 60.0 / (count - 1)), level_plane(31.3));
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, 80 * M_PI, 1.0) << per_ring;
  }
}

TEST(GirthByPaper, StretchesOverHollowsAndTouchesThem) {
  const AnalyticShape lobed{
      [](double angle, double height) {
        const double radius = 40 + 8 * std::cos(3 * angle);
        return Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
      },
      [](const Vector3d& p) {
        return p.head<2>().norm() - 40 - 8 * std::cos(3 * std::atan2(p.y(), p.x()));
      }};
  const auto girth = girth_by_paper(cloud_of(lobed, 6000), level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  const double truth = test::true_girth(lobed, level_plane());
  EXPECT_NEAR(girth->contact_mm, truth, 1.0);
  EXPECT_LT(girth->stretched_mm, truth - 0.5);
}

TEST(GirthByPaper, GivesTheSameInAnotherFrame) {
  const auto cloud = cloud_of(test::elliptic_cylinder(45, 28), 3000);
  RigidTransform moved = RigidTransform::Identity();
  moved.rotate(Eigen::AngleAxisd(0.8, Eigen::Vector3d(2, 1, -0.5).normalized()));
  moved.pretranslate(Eigen::Vector3d(700, -80, 3000));
  const auto here = girth_by_paper(cloud, oblique_plane());
  const auto there = girth_by_paper(transformed(moved, cloud), oblique_plane().transformed(moved));
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(here->stretched_mm, there->stretched_mm, 1e-4);
  EXPECT_NEAR(here->contact_mm, there->contact_mm, 1e-3);
}

void expect_refusal(const PointCloud& cloud, ErrorCode code,
                    const TapePlane& plane = level_plane()) {
  const auto girth = girth_by_paper(cloud, plane);
  ASSERT_FALSE(girth) << girth->stretched_mm;
  EXPECT_EQ(girth.error().code, code) << girth.error().line();
  EXPECT_FALSE(girth.error().advice.empty());
}

TEST(GirthByPaper, RefusesWhereItLosesTheRing) {
  PointCloud half = cloud_of(test::elliptic_cylinder(40, 40), 3000);
  std::erase_if(half.positions, [](const auto& p) { return p.x() < 0.0; });
  expect_refusal(half, ErrorCode::kInsufficientData);
  PointCloud sheet;
  for (int i = 0; i < 900; ++i) sheet.positions.emplace_back(i % 30, 0.0, i / 30 - 15);
  expect_refusal(sheet, ErrorCode::kInsufficientData);
}

TEST(GirthByPaper, RefusesBadInput) {
  expect_refusal({}, ErrorCode::kInvalidInput);
  const auto cloud = cloud_of(test::elliptic_cylinder(40, 40), 1000);
  expect_refusal(cloud, ErrorCode::kInvalidInput, plane_at({0, 0, 500}, {1, 0, 500}, {0, 1, 500}));
  PointCloud broken = cloud;
  broken.positions[3].x() = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(broken, ErrorCode::kInvalidInput);
  PointCloud same;
  same.positions.assign(500, Vector3d(40, 0, 1.3));
  expect_refusal(same, ErrorCode::kInvalidInput);
}

/// The paper's method fails on such clouds; it has to say a number or why not, and end.
TEST(GirthByPaper, NeverBreaksOnUnevenClouds) {
  test::RandomNumbers random(1);
  for (int run = 0; run < 60; ++run) {
    PointCloud cloud;
    const std::size_t count = 3 + random.below(400);
    const double flatness = random.uniform() < 0.3 ? 0.0 : random.uniform(0.1, 60.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double way = random.uniform() < 0.1 ? 1000.0 : 40.0;
      cloud.positions.emplace_back(way * random.normal(), flatness * random.normal(),
                                   random.below(2) == 0 ? 1.3 : 10.0 * random.normal());
      if (random.uniform() < 0.2) cloud.positions.push_back(cloud.positions.front());
    }
    const auto girth = girth_by_paper(cloud, level_plane());
    if (!girth) {
      EXPECT_FALSE(girth.error().line().empty());
      continue;
    }
    EXPECT_TRUE(std::isfinite(girth->stretched_mm) && girth->stretched_mm > 0.0);
    EXPECT_TRUE(std::isfinite(girth->contact_mm));
  }
}

}  // namespace
}  // namespace instep
