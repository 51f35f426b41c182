#include "core/surface/patches/sheet_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

const Vector3d kAlong = Vector3d::UnitY();
const Vector3d kOutward = Vector3d::UnitZ();

/// Rows along y, turned by `angle` about z, each begun anywhere.
OrientedPoints rowed_points(int rows, double apart, int on_each, double step, double angle) {
  test::RandomNumbers random(1);
  OrientedPoints points;
  for (int row = 0; row < rows; ++row) {
    const double first = random.uniform(0.0, step);
    for (int i = 0; i < on_each; ++i) {
      const double x = apart * row;
      const double y = first + step * i;
      const Vector3d place(std::cos(angle) * x - std::sin(angle) * y,
                           std::sin(angle) * x + std::cos(angle) * y, 0.0);
      points.push_back({Vector3d(5.0, -3.0, 2.0) + place, kOutward, 0.0});
    }
  }
  return points;
}

TEST(SheetRows, AreCountedAndMeasured) {
  for (const int rows : {2, 4, 5}) {
    for (const double angle : {0.0, 0.05, -0.15}) {
      const auto found = rows_along(rowed_points(rows, 1.3, 8, 1.0, angle), kAlong, kOutward);
      ASSERT_TRUE(found) << rows << " " << angle;
      EXPECT_EQ(found->count, static_cast<std::size_t>(rows)) << angle;
      EXPECT_NEAR(found->apart, 1.3, 0.05) << rows << " " << angle;
    }
  }
}

TEST(SheetRows, AreThoseAlongTheDirectionAlone) {
  const auto points = rowed_points(4, 1.3, 8, 0.77, 0.0);
  EXPECT_TRUE(rows_along(points, kAlong, kOutward));
  EXPECT_FALSE(rows_along(points, Vector3d(0.6, 0.8, 0.0), kOutward));
  EXPECT_TRUE(rows_along(test::in_another_order(points, 2), kAlong, kOutward));
}

TEST(SheetRows, OnePointIsOnNone) {
  EXPECT_FALSE(rows_along({{Vector3d::Zero(), kOutward, 0.0}}, kAlong, kOutward));
}

TEST(SheetRows, PointsAtRandomLieOnNone) {
  test::RandomNumbers random(4);
  int none = 0;
  for (int draw = 0; draw < 200; ++draw) {
    OrientedPoints points;
    for (int i = 0; i < 25; ++i)
      points.push_back({{random.uniform(), random.uniform(), 0.0}, kOutward, 0.0});
    none += !rows_along(points, kAlong, kOutward);
  }
  EXPECT_EQ(none, 200);
}

}  // namespace
}  // namespace instep
