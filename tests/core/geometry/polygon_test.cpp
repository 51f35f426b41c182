#include "core/geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace instep {
namespace {

using Eigen::Vector2d;

TEST(ConvexHull, KeepsTheCornersOfASquareOnly) {
  const auto hull =
      convex_hull({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0}, {1, 0.5}, {0, 0}});
  EXPECT_EQ(hull.size(), 4U);
  EXPECT_DOUBLE_EQ(perimeter(hull), 4.0);
  EXPECT_DOUBLE_EQ(signed_area(hull), 1.0);
}

TEST(IsRing, TellsAnAreaFromALineAndAPoint) {
  EXPECT_TRUE(is_ring({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_TRUE(is_ring({{0, 0}, {0, 1}, {1, 1}, {1, 0}}));
  EXPECT_TRUE(is_ring({{0, 0}, {1e-7, 0}, {0, 1e-7}}));
  EXPECT_TRUE(is_ring({{0, 0}, {100, 0}, {100, 0.1}, {0, 0.1}}));
  EXPECT_FALSE(is_ring({}));
  EXPECT_FALSE(is_ring({{1, 2}}));
  EXPECT_FALSE(is_ring({{0, 0}, {5, 5}}));
  EXPECT_FALSE(is_ring({{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_FALSE(is_ring({{3, 3}, {3, 3}, {3, 3}, {3, 3}}));
  EXPECT_FALSE(is_ring({{0, 0}, {100, 0}, {100, 1e-6}, {0, 1e-6}}));
}

TEST(ConvexHull, OfARegularPolygonIsThePolygon) {
  const int sides = 120;
  std::vector<Vector2d> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    points.emplace_back(40 * std::cos(angle), 40 * std::sin(angle));
  }
  EXPECT_NEAR(perimeter(convex_hull(points)), sides * 2 * 40 * std::sin(std::numbers::pi / sides),
              1e-10);
}

TEST(ConvexHull, ContainsAllRandomPoints) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vector2d> points(500);
  for (auto& point : points) point = {normal(random), normal(random)};
  const auto hull = convex_hull(points);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    for (const auto& point : points) {
      const Vector2d offset = point - hull[i];
      EXPECT_GE(edge.x() * offset.y() - edge.y() * offset.x(), -1e-12);
    }
  }
}

TEST(ConvexHull, OfALineIsThatOfItsPointsInAnyOrder) {
  // A lobed line runs to and fro a few times, one with many lobes often.
  for (const int lobes : {3, 60}) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 1000; ++i) {
      const double angle = 2 * std::numbers::pi * i / 1000;
      const double radius = 40 + 6 * std::cos(lobes * angle + 0.1);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const auto hull = convex_hull(points);
    EXPECT_LT(perimeter(hull), 2 * std::numbers::pi * 46);
    std::shuffle(points.begin(), points.end(), std::mt19937(3));
    EXPECT_EQ(convex_hull(points), hull) << lobes;
  }
}

TEST(ConvexHull, GivesBackWhatHasNoArea) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 1}, {1, 1}}).size(), 1U);
  EXPECT_EQ(convex_hull(std::vector<Vector2d>(100, {1, 1})).size(), 1U);
  const auto segment = convex_hull({{0, 0}, {3, 0}, {1, 0}, {2, 0}});
  EXPECT_DOUBLE_EQ(perimeter(segment), 6.0);
}

TEST(DepthIn, IsTheWayToTheNearestSideOfARectangle) {
  const std::vector<Vector2d> rectangle = {{10, 20}, {14, 20}, {14, 23}, {10, 23}};
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {12, 21.5}), 1.5);
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {13.5, 21}), 0.5);
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {14, 21}), 0.0);
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {12, 27}), -4.0);
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {8, 21}), -2.0);
  // Past a corner by 3 and 4 the way to it is 5.
  EXPECT_DOUBLE_EQ(depth_in(rectangle, {17, 27}), -4.0);
}

TEST(DepthIn, OfTheMiddleOfAHexagonIsTheRadiusOfItsInnerCircle) {
  std::vector<Vector2d> hexagon;
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 3 * i;
    hexagon.emplace_back(7 + 2 * std::cos(angle), -3 + 2 * std::sin(angle));
  }
  EXPECT_NEAR(depth_in(hexagon, {7, -3}), std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(depth_in(hexagon, {9, -3}), 0.0, 1e-14);
}

TEST(DepthIn, IsWithoutEndInNoPolygon) {
  EXPECT_EQ(depth_in({}, {1, 2}), std::numeric_limits<double>::infinity());
}

TEST(NearestOnBorder, IsOnASideOrAtACorner) {
  const std::vector<Eigen::Vector2d> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto above = nearest_on_border(square, {1, 6});
  EXPECT_DOUBLE_EQ(above.way, 11.0);
  EXPECT_DOUBLE_EQ(above.distance, 2.0);
  const auto beyond = nearest_on_border(square, {7, 8});
  EXPECT_DOUBLE_EQ(beyond.way, 8.0);
  EXPECT_DOUBLE_EQ(beyond.distance, 5.0);
  // The side from the last corner to the first.
  EXPECT_DOUBLE_EQ(nearest_on_border(square, {1, 2}).way, 14.0);
}

TEST(NearestOnBorder, OfOneCornerOrNoneIsThatOrNone) {
  EXPECT_DOUBLE_EQ(nearest_on_border({{1, 1}}, {4, 5}).distance, 5.0);
  EXPECT_EQ(nearest_on_border({}, {4, 5}).distance, std::numeric_limits<double>::infinity());
}

TEST(Clipped, CutsACircleAtAChord) {
  const int sides = 3600;
  std::vector<Vector2d> circle;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  // Above y = -1/2 two thirds of the circle are left, and a chord of length sqrt(3).
  const auto above = clipped(circle, Vector2d::UnitY(), -0.5);
  EXPECT_NEAR(perimeter(above), 4.0 / 3.0 * std::numbers::pi + std::sqrt(3.0), 1e-5);
  for (const auto& point : above) EXPECT_GE(point.y(), -0.5 - 1e-12);
  EXPECT_EQ(clipped(circle, Vector2d::UnitY(), -2.0).size(), circle.size());
  EXPECT_TRUE(clipped(circle, Vector2d::UnitY(), 2.0).empty());
}

}  // namespace
}  // namespace instep
