#include "tests/support/sheet_points.h"

#include <cmath>
#include <numbers>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep::test {

using Eigen::Vector3d;

std::vector<OrientedPoint> plane_points(double sigma) {
  std::vector<OrientedPoint> points;
  RandomNumbers random(1);
  for (int i = -25; i <= 25; ++i) {
    for (int j = -25; j <= 25; ++j) {
      points.push_back({{kSpacing * (i + random.uniform(-0.3, 0.3)),
                         kSpacing * (j + random.uniform(-0.3, 0.3)), sigma * random.normal()},
                        Vector3d::UnitZ(),
                        sigma * sigma});
    }
  }
  return points;
}

std::vector<OrientedPoint> cylinder_columns(double radius, int columns, double pitch) {
  std::vector<OrientedPoint> points;
  for (int column = 0; column < columns; ++column) {
    const double angle = 2.0 * std::numbers::pi * column / columns;
    const Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    for (int row = -40; row <= 40; ++row) {
      points.push_back({radius * normal + row * pitch * Vector3d::UnitZ(), normal, 0.0});
    }
  }
  return points;
}

PatchFitter fitter_of(const std::vector<OrientedPoint>& points) {
  return {points, PointIndex(positions_of(points)), {{Vector3d::Zero(), 0.01}}};
}

}  // namespace instep::test
