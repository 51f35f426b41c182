#include "core/girth/contour/contour_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Corners equally far apart along an ellipse, found on one a thousand times as fine.
Contour even_ellipse(double a, double b, std::size_t count) {
  const std::size_t fine = 1000 * count;
  const auto at = [&](std::size_t i) {
    const double angle = kTurn * static_cast<double>(i) / static_cast<double>(fine);
    return Vector2d(a * std::cos(angle), b * std::sin(angle));
  };
  double length = 0.0;
  for (std::size_t i = 0; i < fine; ++i) length += (at(i + 1) - at(i)).norm();
  Contour contour;
  double way = 0.0;
  for (std::size_t i = 0; i < fine && contour.points.size() < count; ++i) {
    if (way >= length * static_cast<double>(contour.points.size()) / static_cast<double>(count)) {
      contour.points.push_back(at(i));
      contour.outward.push_back(Vector2d(at(i).x() / (a * a), at(i).y() / (b * b)).normalized());
    }
    way += (at(i + 1) - at(i)).norm();
  }
  return contour;
}

/// Looks at every chord.
ContourIndex::Foot foot_by_all_chords(const Contour& contour, const Vector2d& point) {
  ContourIndex::Foot best{std::numeric_limits<double>::infinity(), 0.0};
  double way = 0.0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const Vector2d start = contour.points[i];
    const Vector2d chord = contour.points[(i + 1) % contour.points.size()] - start;
    const double part = std::clamp(chord.dot(point - start) / chord.squaredNorm(), 0.0, 1.0);
    const double distance = (start + part * chord - point).norm();
    if (distance < best.distance) best = {distance, way + part * chord.norm()};
    way += chord.norm();
  }
  return best;
}

double length_of(const Contour& contour) {
  double length = 0.0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    length += (contour.points[(i + 1) % contour.points.size()] - contour.points[i]).norm();
  }
  return length;
}

std::size_t nearest_of_all(const std::vector<Vector2d>& corners, const Vector2d& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double squared = (corners[i] - point).squaredNorm();
    if (squared < least) nearest = i;
    least = std::min(least, squared);
  }
  return nearest;
}

/// Between two places on a closed line.
double way_between(double a, double b, double length) {
  return std::abs(std::remainder(a - b, length));
}

void expect_feet_of_all_chords(double a, double b, std::size_t count, double off) {
  const Contour contour = even_ellipse(a, b, count);
  const ContourIndex index(contour);
  const double length = length_of(contour);
  EXPECT_NEAR(index.length(), length, 1e-12 * length);
  test::RandomNumbers random(1);
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0.0, kTurn);
    const Vector2d on(a * std::cos(angle), b * std::sin(angle));
    const Vector2d outward = Vector2d(on.x() / (a * a), on.y() / (b * b)).normalized();
    const Vector2d point = on + random.uniform(-off, off) * outward;
    const auto foot = index.foot_of(point);
    const auto expected = foot_by_all_chords(contour, point);
    EXPECT_NEAR(foot.distance, expected.distance, 1e-12);
    EXPECT_TRUE(index.passes_within(foot.distance, point));
    EXPECT_FALSE(index.passes_within(std::nextafter(foot.distance, 0.0), point));
    EXPECT_LT(way_between(foot.way, expected.way, length), 1e-9) << point.transpose();
    EXPECT_GE(foot.way, 0.0);
    EXPECT_LE(foot.way, length * (1.0 + 1e-12));
  }
}

TEST(ContourIndex, FindsTheFootOnACircleAsAllChordsDo) {
  expect_feet_of_all_chords(0.35, 0.35, 300, 0.3);
  expect_feet_of_all_chords(0.35, 0.35, 12, 0.3);
}

TEST(ContourIndex, FindsTheFootNearAnEllipseAsAllChordsDo) {
  expect_feet_of_all_chords(0.4, 0.2, 250, 0.03);
  expect_feet_of_all_chords(0.45, 0.1, 250, 0.02);
}

TEST(ContourIndex, FindsTheNearestCornerOfAll) {
  test::RandomNumbers random(1);
  for (const double flat : {1.0, 0.02, 0.0}) {
    std::vector<Vector2d> corners;
    for (int i = 0; i < 90; ++i) {
      corners.emplace_back(random.uniform(-3.0, 2.0), flat * random.uniform(4.0, 9.0));
    }
    const ContourIndex index(corners);
    for (int i = 0; i < 5000; ++i) {
      const Vector2d point(random.uniform(-5.0, 4.0), random.uniform(-1.0, 12.0));
      EXPECT_EQ(index.nearest_corner(point), nearest_of_all(corners, point)) << point.transpose();
    }
  }
}

TEST(ContourIndex, TellsTheFirstOfCornersThatAreAsNear) {
  const ContourIndex index(std::vector<Vector2d>{{0, 0}, {1, 1}, {1, 1}, {0, 0}});
  EXPECT_EQ(index.nearest_corner({0.9, 0.8}), 1U);
  EXPECT_EQ(index.nearest_corner({-50.0, 0.1}), 0U);
  EXPECT_EQ(index.nearest_corner({0.5, 0.5}), 0U);
}

TEST(ContourIndex, TakesASingleCorner) {
  const ContourIndex index(std::vector<Vector2d>{{2, 3}});
  EXPECT_EQ(index.nearest_corner({2, 3}), 0U);
  EXPECT_EQ(index.nearest_corner({7, -3}), 0U);
  EXPECT_EQ(index.length(), 0.0);
}

TEST(ContourIndex, PutsCornersAtTheirWaysAndJoinsTheLastToTheFirst) {
  const Contour square{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {}};
  const ContourIndex index(square);
  EXPECT_DOUBLE_EQ(index.length(), 12.0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(index.foot_of(square.points[i]).distance, 0.0);
    EXPECT_DOUBLE_EQ(index.foot_of(square.points[i]).way, 3.0 * static_cast<double>(i));
  }
  EXPECT_DOUBLE_EQ(index.foot_of({-0.5, 1.0}).way, 11.0);
  EXPECT_DOUBLE_EQ(index.foot_of({-0.5, 1.0}).distance, 0.5);
  EXPECT_DOUBLE_EQ(index.foot_of({4.0, 4.0}).way, 6.0);
  EXPECT_DOUBLE_EQ(index.foot_of({4.0, 4.0}).distance, std::sqrt(2.0));
}

TEST(ContourIndex, TakesCornersThatCoincide) {
  const Contour square{{{0, 0}, {3, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 3}}, {}};
  const ContourIndex index(square);
  EXPECT_DOUBLE_EQ(index.length(), 12.0);
  EXPECT_DOUBLE_EQ(index.foot_of({3.0, 0.0}).distance, 0.0);
  EXPECT_DOUBLE_EQ(index.foot_of({3.0, 0.0}).way, 3.0);
}

}  // namespace
}  // namespace instep
