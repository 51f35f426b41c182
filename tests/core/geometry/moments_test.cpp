#include "core/geometry/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/principal_frame.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> flat_points(const Vector3d& normal, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const Vector3d along = normal.unitOrthogonal();
  const Vector3d across = normal.cross(along);
  std::vector<Vector3d> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back(Vector3d(3, -2, 5) + random.uniform(-1, 1) * along +
                     random.uniform(-1, 1) * across + 0.01 * random.normal() * normal);
  }
  return points;
}

Moments moments_of(const std::vector<Vector3d>& points, std::size_t from, std::size_t to,
                   const Vector3d& origin) {
  Moments moments;
  for (std::size_t i = from; i < to; ++i) moments.add(points[i] - origin);
  return moments;
}

TEST(Moments, HaveTheMiddleAndTheNormalOfFlatPoints) {
  const Vector3d normal = Vector3d(1, 2, -2).normalized();
  const auto points = flat_points(normal, 1);
  const auto moments = moments_of(points, 0, points.size(), points.front());
  const Vector3d middle = points.front() + moments.middle();
  EXPECT_NEAR((middle - spread_of(points).mean).norm(), 0.0, 1e-12);
  EXPECT_GT(std::abs(moments.flattest().dot(normal)), 0.999);
}

TEST(Moments, OfPartsRoundTheirOwnMiddlesAddUp) {
  const auto points = flat_points(Vector3d::UnitY(), 2);
  const Vector3d first = points[0];
  Moments sum = moments_of(points, 0, 15, first);
  const auto others = moments_of(points, 15, points.size(), first);
  const Vector3d middle = first + others.middle();
  sum.add(moments_of(points, 15, points.size(), middle), middle - first);
  const auto whole = moments_of(points, 0, points.size(), first);
  EXPECT_EQ(sum.count, whole.count);
  EXPECT_NEAR((sum.sum - whole.sum).norm(), 0.0, 1e-12);
  EXPECT_NEAR((sum.squares - whole.squares).norm(), 0.0, 1e-12);
}

TEST(Moments, OfPointsAreRoundTheFirst) {
  // Far off, where squares round the origin would keep no digit of them.
  const Vector3d far(1e9, -2e9, 3e9);
  const std::vector<Vector3d> corners = {{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {0, 2, 0}};
  std::vector<Vector3d> points;
  for (const auto& corner : corners) points.push_back(far + corner);
  const auto moments = Moments::of(points);
  EXPECT_EQ(moments.count, 4.0);
  EXPECT_EQ(points.front() + moments.middle(), far + Vector3d(3, 1, 0));
  EXPECT_NEAR(std::abs(moments.flattest().z()), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(moments.longest().x()), 1.0, 1e-12);
}

/// Corners of a box.
SpreadAxes axes_of_box(double length, double breadth, double height) {
  std::vector<Vector3d> corners;
  for (const double x : {0.0, length}) {
    for (const double y : {0.0, breadth}) {
      for (const double z : {0.0, height}) corners.emplace_back(x, y, z);
    }
  }
  return Moments::of(corners).axes();
}

TEST(LiesAsSkin, WhatIsFlatAndNoLine) {
  EXPECT_TRUE(lies_as_skin(axes_of_box(10, 10, 0)));
  EXPECT_TRUE(lies_as_skin(axes_of_box(10, 4, 1.5)));
  EXPECT_FALSE(lies_as_skin(axes_of_box(10, 10, 10))) << "a heap";
  EXPECT_FALSE(lies_as_skin(axes_of_box(10, 4, 1.6)));
  EXPECT_FALSE(lies_as_skin(axes_of_box(10, 0.5, 0.1))) << "a line";
  EXPECT_FALSE(lies_as_skin(axes_of_box(10, 3.8, 0)));
  EXPECT_FALSE(lies_as_skin(axes_of_box(0, 0, 0))) << "one place";
}

}  // namespace
}  // namespace instep
