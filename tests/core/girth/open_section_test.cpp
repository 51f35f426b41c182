#include "core/girth/open_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kSoleMm = 24.0;

test::AnalyticShape foot_like() {
  return test::flat_soled_cylinder(50.0, 40.0, kSoleMm);
}

PointCloud without_sole(double sigma_mm) {
  auto cloud = test::random_points(foot_like(), 9000, -30.0, 30.0, sigma_mm, 3);
  std::erase_if(cloud.positions,
                [&](const auto& p) { return p.y() < -kSoleMm + 0.01 + 3.0 * sigma_mm; });
  return cloud;
}

/// An ellipse of which the directions within so many degrees of one are missing.
PointCloud without_side(double middle_deg, double half_deg) {
  auto cloud = test::random_points(test::elliptic_cylinder(50.0, 45.0), 8000, -30.0, 30.0, 0.0, 5);
  std::erase_if(cloud.positions, [&](const auto& p) {
    const double angle = std::atan2(p.y(), p.x()) * 180.0 / std::numbers::pi;
    return std::abs(std::remainder(angle - middle_deg, 360.0)) < half_deg;
  });
  return cloud;
}

TEST(OpenSection, LaysTheTapeStraightOverASoleThatNobodySaw) {
  const double girth_mm = test::true_girth(foot_like(), test::level_plane());
  const double sole_mm = 100.0 * std::sqrt(1.0 - std::pow(kSoleMm / 40.0, 2));
  for (const double sigma_mm : {0.0, 0.3}) {
    const auto girth = girth_by_rbf(without_sole(sigma_mm), test::level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, girth_mm, 3.0) << sigma_mm;
    EXPECT_NEAR(girth->largest_gap_mm, sole_mm, 4.0) << sigma_mm;
    EXPECT_THAT(girth->warnings, Contains(HasSubstr("the section is open over")));
  }
}

TEST(OpenSection, ItsIntervalReachesToARoundBody) {
  const double girth_mm =
      test::true_girth(test::elliptic_cylinder(50.0, 45.0), test::level_plane());
  for (const double middle_deg : {0.0, 50.0, 90.0, 170.0, 260.0}) {
    const auto girth = girth_by_rbf(without_side(middle_deg, 42.0), test::level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_LT(girth->stretched_mm, girth_mm) << middle_deg;
    EXPECT_LE(girth_mm - girth->stretched_mm, *girth->stretched_u95_mm) << middle_deg;
    EXPECT_LT(*girth->stretched_u95_mm, 4.0 * (girth_mm - girth->stretched_mm)) << middle_deg;
  }
}

/// A floor beside an open sole leads away from it: nothing tells where the skin ends.
TEST(OpenSection, IsNoneWhereTheSkinTurnsAwayFromIt) {
  for (const double width_mm : {6.0, 12.0, 20.0}) {
    auto cloud = without_sole(0.0);
    test::RandomNumbers random(7);
    const double rim_mm = 50.0 * std::sqrt(1.0 - std::pow(kSoleMm / 40.0, 2));
    for (int i = 0; i < 1500; ++i) {
      const double beyond = random.uniform(0.0, width_mm);
      cloud.positions.emplace_back(rim_mm + beyond, -kSoleMm, random.uniform(-30.0, 30.0));
      cloud.positions.emplace_back(-rim_mm - beyond, -kSoleMm, random.uniform(-30.0, 30.0));
    }
    EXPECT_FALSE(girth_over_opening(cloud, test::level_plane(), {})) << width_mm;
  }
}

/// The tip of a flat body is far longer than an arc over it.
TEST(OpenSection, IsNoneWhereABodyMayTaper) {
  auto cloud = test::random_points(test::elliptic_cylinder(50.0, 15.0), 8000, -30.0, 30.0, 0.0, 5);
  std::erase_if(cloud.positions, [](const auto& p) { return p.x() > 35.0; });
  EXPECT_FALSE(girth_over_opening(cloud, test::level_plane(), {}));
}

/// A few points beside the plane show that a body goes on in the opening.
TEST(OpenSection, ItsIntervalReachesToPointsInTheOpening) {
  // Flat as a sole, so that an arc adds little.
  auto cloud = without_sole(0.0);
  for (const double x : {-12.0, -4.0, 4.0, 12.0}) {
    for (const double z : {-6.0, 6.0}) cloud.positions.emplace_back(x, -kSoleMm - 16.0, z);
  }
  const auto girth = girth_over_opening(cloud, test::level_plane(), {});
  ASSERT_TRUE(girth);
  const double without_mm =
      *girth_over_opening(without_sole(0.0), test::level_plane(), {})->stretched_u95_mm;
  EXPECT_GT(*girth->stretched_u95_mm, without_mm + 5.0);
}

/// Errors that points share widen it and are no reason to refuse it.
TEST(OpenSection, IsToldOfPointsThatShareTheirErrors) {
  auto cloud = without_side(90.0, 58.0);
  for (const auto& p : cloud.positions) {
    cloud.normals.emplace_back(Eigen::Vector3d(p.x() / 2500.0, p.y() / 2025.0, 0.0).normalized());
  }
  const auto alone = girth_by_rbf(cloud, test::level_plane());
  ASSERT_TRUE(alone) << alone.error().line();
  ASSERT_GT(*alone->stretched_u95_mm, 0.1 * alone->stretched_mm);
  cloud.shared_errors_mm.push_back(std::vector<double>(cloud.size(), 1e-3));
  const auto girth = girth_by_rbf(cloud, test::level_plane());
  ASSERT_TRUE(girth) << girth.error().line();
  EXPECT_GE(*girth->stretched_u95_mm, *alone->stretched_u95_mm);
}

TEST(OpenSection, IsRefusedWhereHalfOfABodyIsMissing) {
  EXPECT_FALSE(girth_over_opening(without_side(30.0, 90.0), test::level_plane(), {}));
}

TEST(OpenSection, IsNoneOfABodyThatWasSeenAllRound) {
  const auto cloud = test::random_points(foot_like(), 9000, -30.0, 30.0, 0.0, 3);
  EXPECT_FALSE(girth_over_opening(cloud, test::level_plane(), {}));
}

TEST(OpenSection, IsNoneWhereTwoSidesAreMissing) {
  auto cloud = without_side(0.0, 40.0);
  std::erase_if(cloud.positions, [&](const auto& p) { return p.x() < -30.0; });
  EXPECT_FALSE(girth_over_opening(cloud, test::level_plane(), {}));
}

}  // namespace
}  // namespace instep
