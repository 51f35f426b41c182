#include "core/geometry/ordered_spacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/point_spacing.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Round a body, far closer on one side of it.
Points in_order(std::size_t count) {
  test::RandomNumbers random(4);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 6.0 * std::pow(random.uniform(0.0, 1.0), 3);
    points.emplace_back(40.0 * std::cos(angle), 30.0 * std::sin(angle), random.uniform(-2.0, 2.0));
  }
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  return points;
}

TEST(UsualSpacingInOrder, IsTheOneThatAnIndexTells) {
  for (const std::size_t count : {2U, 5U, 9U, 10U, 300U, 4000U}) {
    const Points points = in_order(count);
    EXPECT_EQ(usual_spacing_in_order(points, 200), usual_spacing(PointIndex(points), 200)) << count;
  }
}

TEST(UsualSpacingInOrder, KnowsPointsAtOnePlaceAndInOnePlane) {
  Points points(30, {1.0, 2.0, 3.0});
  EXPECT_EQ(usual_spacing_in_order(points, 10), 0.0);
  for (int i = 0; i < 40; ++i) points.emplace_back(1.0, 3.0 + i, 3.0);
  EXPECT_EQ(usual_spacing_in_order(points, 70), usual_spacing(PointIndex(points), 70));
}

TEST(UsualSpacingInOrder, IsZeroWhereThereIsNone) {
  EXPECT_EQ(usual_spacing_in_order({}, 10), 0.0);
  EXPECT_EQ(usual_spacing_in_order({{1.0, 2.0, 3.0}}, 10), 0.0);
}

}  // namespace
}  // namespace instep
