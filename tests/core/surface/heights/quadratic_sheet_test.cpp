#include "core/surface/heights/quadratic_sheet.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

const Vector3d kCentre(2.0, -1.0, 0.5);
constexpr double kRadius = 3.0;

double saddle(double x, double y) {
  return 0.2 + 0.1 * x - 0.3 * y + 0.05 * x * x - 0.08 * x * y + 0.02 * y * y;
}

/// Over the plane that faces `outward`; `x` and `y` along any two directions of it.
Vector3d on_saddle(const Vector3d& outward, double x, double y) {
  const Vector3d along = outward.unitOrthogonal();
  return kCentre + x * along + y * outward.cross(along) + saddle(x, y) * outward;
}

std::vector<OrientedPoint> saddle_points(const Vector3d& outward, std::size_t count) {
  test::RandomNumbers random(1);
  std::vector<OrientedPoint> points;
  while (points.size() < count) {
    points.push_back(
        {on_saddle(outward, random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)), outward, 0.0});
  }
  return points;
}

TEST(QuadraticSheet, IsTheQuadraticThatThePointsLieOn) {
  for (const Vector3d& outward : {Vector3d(0.0, 0.0, 1.0), Vector3d(0.48, -0.6, 0.64)}) {
    for (const std::size_t count : {8U, 40U}) {
      const QuadraticSheet sheet(saddle_points(outward, count), outward, kCentre, kRadius);
      for (const double x : {-1.5, 0.0, 0.7}) {
        const Vector3d place = on_saddle(outward, x, 0.4);
        EXPECT_NEAR(sheet.at(place).value, 0.0, 1e-9);
        EXPECT_NEAR(sheet.at(place + 0.3 * outward).value, 0.3, 1e-9);
      }
    }
  }
}

TEST(QuadraticSheet, GradientIsThatOfItsValue) {
  const Vector3d outward(0.48, -0.6, 0.64);
  const QuadraticSheet sheet(saddle_points(outward, 20), outward, kCentre, kRadius);
  const Vector3d place = on_saddle(outward, 0.4, -0.9) + 0.1 * outward;
  const auto slope = test::slope_by_differences(
      [&](const Vector3d& at) { return sheet.at(at).value; }, place, 1e-5);
  EXPECT_LT((sheet.at(place).gradient - slope).norm(), 1e-8);
}

}  // namespace
}  // namespace instep
