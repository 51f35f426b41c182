#include "core/geometry/rectangle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

using Eigen::Vector2d;

TEST(EnclosingRectangle, OfATurnedRectangleIsItself) {
  for (const double angle : {0.0, 0.3, 1.1, 2.5}) {
    const Eigen::Rotation2Dd turn(angle);
    std::vector<Vector2d> points;
    for (const Vector2d& corner : {Vector2d(0, 0), {7, 0}, {7, 3}, {0, 3}, {2, 1}}) {
      points.push_back(turn * corner);
    }
    const auto sides = enclosing_rectangle(convex_hull(points));
    EXPECT_NEAR(sides.length, 7.0, 1e-12);
    EXPECT_NEAR(sides.width, 3.0, 1e-12);
  }
}

TEST(EnclosingRectangle, OfADiscIsItsDiameter) {
  std::vector<Vector2d> points;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    points.emplace_back(50 * std::cos(angle), 50 * std::sin(angle));
  }
  const auto sides = enclosing_rectangle(convex_hull(points));
  EXPECT_NEAR(sides.length, 100.0, 0.02);
  EXPECT_NEAR(sides.width, 100.0, 0.02);
}

TEST(EnclosingRectangle, OfTooFewPointsIsFlat) {
  EXPECT_EQ(enclosing_rectangle({}).length, 0.0);
  EXPECT_EQ(enclosing_rectangle({{1, 1}}).length, 0.0);
  const auto sides = enclosing_rectangle({{0, 0}, {3, 4}});
  EXPECT_NEAR(sides.length, 5.0, 1e-12);
  EXPECT_NEAR(sides.width, 0.0, 1e-12);
}

}  // namespace
}  // namespace instep
