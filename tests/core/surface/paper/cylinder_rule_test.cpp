#include "core/surface/paper/cylinder_rule.h"

#include <gtest/gtest.h>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points random_points(std::size_t count) {
  test::RandomNumbers random(6);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-20, 20), random.uniform(-10, 10), random.uniform(-3, 3));
  }
  return points;
}

/// The paper's steps (1) to (5), counted anew at each radius.
Extent range_by_steps(const Points& points, double radius, Eigen::Index axis,
                      const Vector3d& place) {
  for (;; radius *= 2.0) {
    Extent range = Extent::none();
    std::size_t inside = 0;
    for (const auto& point : points) {
      Vector3d offset = point - place;
      offset[axis] = 0.0;
      if (offset.norm() > radius) continue;
      ++inside;
      range.include(point[axis]);
    }
    if (10 * inside >= points.size()) return range;
  }
}

TEST(CylinderRule, FollowsThePapersStepsAlongEachAxis) {
  for (const std::size_t count : {1U, 9U, 10U, 11U, 500U, 20000U}) {
    const auto points = random_points(count);
    const CylinderRule rule(points, 0.7);
    for (const auto& place : {Vector3d(0, 0, 0), Vector3d(19, -9, 2), Vector3d(60, 5, 0)}) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto expected = range_by_steps(points, 0.7, axis, place);
        const auto range = rule.range(axis, place);
        EXPECT_EQ(range.from, expected.from) << count << " points, axis " << axis;
        EXPECT_EQ(range.to, expected.to);
      }
    }
  }
}

TEST(CylinderRule, AdmitsWhatMeetsTheOutermostPointsOfItsCylinder) {
  Points points;
  for (int i = 0; i < 100; ++i) points.emplace_back(i % 10, i / 10, i % 2 == 0 ? 1.0 : 2.0);
  const Extent range = CylinderRule(points, 1.5).range(2, {4.5, 4.5, 100.0});
  EXPECT_TRUE(range.meets(1.2, 1.3));
  EXPECT_TRUE(range.meets(0.5, 1.0));
  EXPECT_TRUE(range.meets(2.0, 9.0));
  EXPECT_FALSE(range.meets(0.5, 0.99));
  EXPECT_FALSE(range.meets(2.01, 9.0));
}

}  // namespace
}  // namespace instep
