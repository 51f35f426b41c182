#include "core/geometry/coordinate_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

std::vector<Eigen::Vector3d> drawn(const Eigen::Vector3d& steps) {
  test::RandomNumbers random(1);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20000; ++i) {
    Eigen::Vector3d point(random.uniform(-50, 50), random.uniform(900, 1000), random.uniform(0, 9));
    for (int axis = 0; axis < 3; ++axis) {
      if (steps[axis] > 0.0) point[axis] = steps[axis] * std::round(point[axis] / steps[axis]);
    }
    points.push_back(point);
  }
  return points;
}

TEST(CoordinateStep, IsTheFinestOfTheAxes) {
  EXPECT_NEAR(coordinate_step(drawn({0.2, 0.5, 0.25})), 0.2, 1e-9);
  EXPECT_LT(coordinate_step(drawn({0.0, 0.0, 1.0})), 1e-6) << "rows of a scanner";
}

TEST(CoordinateStep, IsThatOfAxesThatVary) {
  auto points = drawn({0.5, 0.5, 0.5});
  for (auto& point : points) point.z() = 3.3;
  EXPECT_NEAR(coordinate_step(points), 0.5, 1e-9);
}

/// Two bodies apart, written as numbers of seven digits.
TEST(CoordinateStep, IsToldAcrossGaps) {
  auto points = drawn({0.2, 0.2, 0.2});
  for (std::size_t i = 0; i < points.size(); i += 2) points[i].array() += 200.0;
  for (auto& point : points) point = point.cast<float>().cast<double>();
  EXPECT_NEAR(coordinate_step(points), 0.2, 1e-4);
}

TEST(CoordinateStep, IsWhateverTheFirstCoordinateIs) {
  auto points = drawn({1.0, 1.0, 1.0});
  for (auto& point : points) point += Eigen::Vector3d(0.3, 0.77, -5.1);
  EXPECT_NEAR(coordinate_step(points), 1.0, 1e-9);
}

TEST(CoordinateStep, IsNextToNoneOfNumbersWithAllTheirDigits) {
  EXPECT_LT(coordinate_step(drawn({0.0, 0.0, 0.0})), 1e-6);
  auto floats = drawn({0.0, 0.0, 0.0});
  for (auto& point : floats) point = point.cast<float>().cast<double>();
  EXPECT_LT(coordinate_step(floats), 1e-3);
}

TEST(CoordinateStep, IsNoneOfOneCoordinate) {
  EXPECT_EQ(coordinate_step({}), 0.0);
  EXPECT_EQ(coordinate_step({{1, 2, 3}}), 0.0);
  EXPECT_EQ(coordinate_step({{1, 2, 3}, {1, 2, 3}}), 0.0);
}

TEST(CoordinateStep, IsOverWhatIsLess) {
  for (const double step : {0.01, 0.2, 1.0}) {
    const auto points = drawn({step, step, step});
    EXPECT_TRUE(is_coordinate_step_over(0.9 * step, points)) << step;
    EXPECT_FALSE(is_coordinate_step_over(1.1 * step, points)) << step;
  }
  EXPECT_FALSE(is_coordinate_step_over(1e-3, drawn({0.0, 0.0, 1.0})));
  EXPECT_FALSE(is_coordinate_step_over(1e-6, drawn({0.0, 0.0, 0.0})));
  EXPECT_FALSE(is_coordinate_step_over(0.0, {{1, 2, 3}}));
  EXPECT_FALSE(is_coordinate_step_over(0.0, {}));
}

}  // namespace
}  // namespace instep
