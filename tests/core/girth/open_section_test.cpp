#include "core/girth/open_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"

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
  auto cloud = test::random_points(test::elliptic_cylinder(50.0, 38.0), 8000, -30.0, 30.0, 0.0, 5);
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
      test::true_girth(test::elliptic_cylinder(50.0, 38.0), test::level_plane());
  for (const double middle_deg : {0.0, 50.0, 90.0, 170.0, 260.0}) {
    const auto girth = girth_by_rbf(without_side(middle_deg, 50.0), test::level_plane());
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_LT(girth->stretched_mm, girth_mm) << middle_deg;
    EXPECT_LE(girth_mm - girth->stretched_mm, *girth->stretched_u95_mm) << middle_deg;
    EXPECT_LT(*girth->stretched_u95_mm, 0.15 * girth_mm) << middle_deg;
  }
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
