#include "core/foot/skin/end_facing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A toe along x: a shaft of that radius with a half ball on its end, at x = `radius`.
std::vector<Vector3d> toe(double radius, double noise_mm) {
  test::RandomNumbers random(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double along = random.uniform(-30.0, radius);  // even on both, by Archimedes
    const double across = along < 0.0 ? radius : std::sqrt(radius * radius - along * along);
    points.emplace_back(along, across * std::cos(angle), across * std::sin(angle));
    points.back() += noise_mm * Vector3d(random.normal(), random.normal(), random.normal());
  }
  return points;
}

TEST(EndFacing, IsNearOneWhereAToeClosesAndNearNoneWhereItIsCutOff) {
  for (const double radius : {7.0, 12.0, 25.0}) {
    for (const double noise_mm : {0.0, 0.4}) {
      SCOPED_TRACE(testing::Message() << radius << " " << noise_mm);
      auto points = toe(radius, noise_mm);
      EXPECT_GT(*end_facing(points, {radius, 0, 0}, Vector3d::UnitX()), 0.8);
      std::erase_if(points, [](const Vector3d& point) { return point.x() > -5.0; });
      EXPECT_LT(*end_facing(points, {-5.0, radius, 0}, Vector3d::UnitX()), 0.25);
    }
  }
}

TEST(EndFacing, IsNotToldWithoutPoints) {
  EXPECT_FALSE(end_facing({}, {0, 0, 0}, Vector3d::UnitX()));
  EXPECT_FALSE(end_facing({{-100, 0, 0}}, {0, 0, 0}, Vector3d::UnitX()));
}

/// Of a crowd each point had all others for neighbours: 60,000 took over a minute.
TEST(EndFacing, IsToldOfACrowd) {
  auto points = toe(12.0, 0.0);
  test::RandomNumbers random(5);
  for (int i = 0; i < 300000; ++i) {
    points.emplace_back(12.0 + 0.1 * random.normal(), 0.1 * random.normal(), 0.1 * random.normal());
  }
  EXPECT_GT(*end_facing(points, {12.0, 0, 0}, Vector3d::UnitX()), 0.8);
}

}  // namespace
}  // namespace instep
