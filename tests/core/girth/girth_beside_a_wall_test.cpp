// Girths of a body beside an open surface that the tape plane cuts as well.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kRadius = 40.0;
constexpr double kGirth = 2.0 * std::numbers::pi * kRadius;
constexpr double kHalfHeight = 30.0;
constexpr double kPointsOnASquareMillimetre = 0.4;

/// A cylinder with a wall 20 mm beside it, as dense.
PointCloud cylinder_by_a_wall(double wall) {
  const auto count = [](double length) {
    return static_cast<std::size_t>(kPointsOnASquareMillimetre * 2.0 * kHalfHeight * length);
  };
  PointCloud cloud = test::random_points(test::elliptic_cylinder(kRadius, kRadius), count(kGirth),
                                         -kHalfHeight, kHalfHeight, 0.0, 1);
  test::RandomNumbers random(2);
  for (std::size_t i = 0; i < count(wall); ++i) {
    cloud.positions.emplace_back(-kRadius - 20.0, random.uniform(-0.5 * wall, 0.5 * wall),
                                 random.uniform(-kHalfHeight, kHalfHeight));
  }
  return cloud;
}

Result<Girth> girth_by_a_wall(double wall) {
  return girth_by_rbf(cylinder_by_a_wall(wall),
                      TapePlane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value());
}

/// However many points are of the wall: it closes nowhere, and the body does.
TEST(GirthBesideAWall, IsToldWithAWarning) {
  for (const double wall : {300.0, 900.0}) {
    const auto girth = girth_by_a_wall(wall);
    ASSERT_TRUE(girth) << girth.error().line();
    EXPECT_NEAR(girth->stretched_mm, kGirth, 0.01);
    ASSERT_FALSE(girth->warnings.empty());
    EXPECT_NE(girth->warnings.front().find("beside the section"), std::string::npos);
  }
}

}  // namespace
}  // namespace instep
