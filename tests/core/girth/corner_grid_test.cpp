#include "core/girth/corner_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;

std::size_t nearest_of_all(const std::vector<Vector2d>& corners, const Vector2d& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double distance = (corners[i] - point).norm();
    if (distance < least) nearest = i;
    least = std::min(least, distance);
  }
  return nearest;
}

TEST(CornerGrid, FindsTheNearestOfAll) {
  test::RandomNumbers random(1);
  for (const double flat : {1.0, 0.02, 0.0}) {
    std::vector<Vector2d> corners;
    for (int i = 0; i < 90; ++i) {
      corners.emplace_back(random.uniform(-3.0, 2.0), flat * random.uniform(4.0, 9.0));
    }
    const CornerGrid grid(corners);
    for (int i = 0; i < 5000; ++i) {
      const Vector2d point(random.uniform(-5.0, 4.0), random.uniform(-1.0, 12.0));
      EXPECT_EQ(grid.nearest(point), nearest_of_all(corners, point)) << point.transpose();
    }
  }
}

TEST(CornerGrid, TellsTheFirstOfCopies) {
  const CornerGrid grid({{0, 0}, {1, 1}, {1, 1}, {0, 0}});
  EXPECT_EQ(grid.nearest({0.9, 0.8}), 1U);
  EXPECT_EQ(grid.nearest({-50.0, 0.1}), 0U);
}

TEST(CornerGrid, TakesASinglePlace) {
  const CornerGrid grid({{2, 3}});
  EXPECT_EQ(grid.nearest({2, 3}), 0U);
  EXPECT_EQ(grid.nearest({7, -3}), 0U);
  EXPECT_EQ(grid.nearest(Vector2d::Constant(std::numeric_limits<double>::quiet_NaN())), 0U);
}

}  // namespace
}  // namespace instep
