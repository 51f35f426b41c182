#include "core/girth/contour/section_gaps.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

const std::vector<Eigen::Vector2d> kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(SectionGaps, IsTheLongestWayBetweenPointsAlongTheContour) {
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, {{5, 0.1}, {10.2, 5}, {5, 9}}), 20.0);
}

TEST(SectionGaps, IsTheWholeContourWithoutPoints) {
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, {}), 40.0);
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, {{0, 30}}, 5.0), 40.0);
}

TEST(SectionGaps, DoesNotCountPointsOutOfReach) {
  const std::vector<Eigen::Vector2d> points = {{5, 0}, {10, 5}, {-3, 5}};
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, points), 20.0);
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, points, 3.0), 20.0);
  EXPECT_DOUBLE_EQ(largest_gap(kSquare, points, 2.9), 30.0);
}

}  // namespace
}  // namespace instep
