#include "daemon/page/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// The cells whose middles lie between two radii round a place.
std::vector<GridCell> ring_of_cells(double inner, double outer, int row, int column) {
  std::vector<GridCell> cells;
  const int reach = static_cast<int>(outer) + 1;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const double distance = std::hypot(x, y);
      if (distance >= inner && distance <= outer) cells.emplace_back(row + y, column + x);
    }
  }
  return cells;
}

TEST(Silhouette, OfADiscIsACircle) {
  const auto outlines = silhouette(ring_of_cells(0.0, 30.0, 5, -7));
  ASSERT_EQ(outlines.size(), 1U);
  for (const auto& corner : outlines[0]) {
    EXPECT_NEAR((corner - Eigen::Vector2d(-7.0, 5.0)).norm(), 30.0, 1.0);
  }
  // Smooth: the way round is that of the circle, not the 8 / 2 pi = 1.27 times of its stairs.
  EXPECT_NEAR(perimeter(outlines[0]), 2.0 * std::numbers::pi * 29.6, 6.0);
}

TEST(Silhouette, OfARingHasItsHole) {
  auto outlines = silhouette(ring_of_cells(12.0, 30.0, 0, 0));
  ASSERT_EQ(outlines.size(), 2U);
  const double areas = signed_area(outlines[0]) + signed_area(outlines[1]);
  // They run opposite ways, so the areas take each other off.
  EXPECT_NEAR(std::abs(areas), std::numbers::pi * (30.0 * 30.0 - 12.0 * 12.0), 150.0);
}

TEST(Silhouette, RunsThroughTheMiddlesOfTheLastCells) {
  std::vector<GridCell> square;
  for (int row = 0; row <= 20; ++row) {
    for (int column = 0; column <= 40; ++column) square.emplace_back(row, column);
  }
  const auto outlines = silhouette(square);
  ASSERT_EQ(outlines.size(), 1U);
  for (const auto& corner : outlines[0]) {
    const bool is_in_the_middle_of_an_edge = corner.x() > 10.0 && corner.x() < 30.0;
    if (is_in_the_middle_of_an_edge) {
      EXPECT_NEAR(std::min(corner.y(), 20.0 - corner.y()), 0.0, 1e-9);
    }
  }
}

TEST(Silhouette, KeepsTwoBodiesApart) {
  auto cells = ring_of_cells(0.0, 8.0, 0, 0);
  const auto other = ring_of_cells(0.0, 8.0, 0, 30);
  cells.insert(cells.end(), other.begin(), other.end());
  EXPECT_EQ(silhouette(cells).size(), 2U);
}

TEST(Silhouette, OfNothingOrASingleCellIsNothing) {
  EXPECT_TRUE(silhouette({}).empty());
  EXPECT_TRUE(silhouette({{3, 4}}).empty());
}

}  // namespace
}  // namespace instep
