#include "core/girth/contour/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.5;

/// Corners on a circle with its true normals, by uneven steps.
Contour circle_of_corners(int count) {
  Contour circle;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * (i + 0.3 * std::sin(1.7 * i)) / count;
    circle.outward.emplace_back(std::cos(angle), std::sin(angle));
    circle.points.push_back(Vector2d(3.0, -2.0) + kRadius * circle.outward.back());
  }
  return circle;
}

double polygon_length(const std::vector<Vector2d>& corners) {
  double length = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  }
  return length;
}

TEST(Contour, OfACircleIsAsLongAsItsArcs) {
  const double length = 2.0 * kPi * kRadius;
  const auto circle = circle_of_corners(100);
  EXPECT_NEAR(circle.length(), length, 1e-6 * length);
  EXPECT_LT(polygon_length(circle.points), (1.0 - 1e-4) * length);
  // Twice the corners, a sixteenth of the error.
  const double coarse = std::abs(circle_of_corners(20).length() - length);
  const double fine = std::abs(circle_of_corners(40).length() - length);
  EXPECT_LT(fine, coarse / 8.0);
}

TEST(Contour, GoesRoundOnceCounterClockwise) {
  const auto circle = circle_of_corners(100);
  EXPECT_TRUE(circle.goes_round_once());
  auto backwards = circle;
  std::reverse(backwards.points.begin(), backwards.points.end());
  EXPECT_FALSE(backwards.goes_round_once());
  const auto lap = circle_of_corners(90);
  auto twice = circle;
  twice.points.insert(twice.points.end(), lap.points.begin(), lap.points.end());
  EXPECT_FALSE(twice.goes_round_once());
}

TEST(Contour, WithoutTurnsIsAsLongAsItsChords) {
  const Contour square{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, {5, Vector2d(0, -1)}};
  EXPECT_NEAR(square.length(), 8.0, 1e-12);
}

TEST(Contour, ATapeRoundACircleIsAsLongAsItsArcs) {
  const double length = 2.0 * kPi * kRadius;
  const auto circle = circle_of_corners(100);
  EXPECT_NEAR(circle.tape_length(), length, 1e-6 * length);
  EXPECT_LT(polygon_length(circle.refined(8)), (1.0 - 2e-6) * length) << "by chords alone";
}

/// A circle with its right side pressed in: the tape spans the hollow.
TEST(Contour, ATapeBridgesAHollowInAStraightLine) {
  constexpr int kCorners = 1200;
  constexpr double kFrom = kPi / 3.0;  // of the hollow, to as far below
  Contour pressed;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    const Vector2d outward(std::cos(angle), std::sin(angle));
    const bool hollow = outward.x() > std::cos(kFrom) + 1e-9;
    pressed.outward.push_back(hollow ? Vector2d(outward.x(), -outward.y()) : outward);
    pressed.points.emplace_back(hollow ? 1.0 - outward.x() : outward.x(), outward.y());
  }
  const double arc = 2.0 * kPi - 2.0 * kFrom;
  const double bridge = 2.0 * std::sin(kFrom);
  EXPECT_NEAR(pressed.tape_length(), arc + bridge, 2e-3);
  EXPECT_NEAR(polygon_length(pressed.points), 2.0 * kPi, 2e-3) << "the contour goes in and out";
}

TEST(Contour, RefinedStaysOnTheCircle) {
  const auto circle = circle_of_corners(40);
  const auto fine = circle.refined(8);
  ASSERT_EQ(fine.size(), 320U);
  // The chord of the longest step, of a quarter radian, is 4e-3 off the circle in its middle.
  for (const auto& point : fine) {
    EXPECT_NEAR((point - Vector2d(3.0, -2.0)).norm(), kRadius, 4e-5);
  }
  EXPECT_NEAR(polygon_length(fine), 2.0 * kPi * kRadius, 1e-3);
  for (std::size_t i = 0; i < circle.points.size(); ++i) {
    EXPECT_NEAR((fine[8 * i] - circle.points[i]).norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace instep
