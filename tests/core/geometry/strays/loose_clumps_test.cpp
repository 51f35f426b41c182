#include "core/geometry/strays/loose_clumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::RandomNumbers;
using Points = std::vector<Vector3d>;

/// A sheet of points at random, one on each square millimetre.
Points sheet(double length_mm, double width_mm, RandomNumbers& random) {
  Points points;
  for (int i = 0; i < static_cast<int>(length_mm * width_mm); ++i) {
    points.emplace_back(random.uniform(0.0, length_mm), random.uniform(0.0, width_mm), 0.0);
  }
  return points;
}

void add_clump(Points& points, int count, const Vector3d& middle, double spread_mm,
               RandomNumbers& random) {
  for (int i = 0; i < count; ++i) {
    const Vector3d off(random.normal(), random.normal(), random.normal());
    points.push_back(middle + spread_mm * off);
  }
}

std::ptrdiff_t loose_among(const Points& points, double spacing) {
  const auto loose = loose_clumps(points, spacing);
  return std::count(loose.begin(), loose.end(), true);
}

TEST(LooseClumps, AreThoseThatNoSkinReaches) {
  RandomNumbers random(3);
  for (const int count : {4, 8, 15}) {
    for (const double spread : {0.3, 1.0, 2.0}) {
      Points points = sheet(100.0, 100.0, random);
      const std::size_t skin = points.size();
      add_clump(points, count, {50.0, 50.0, 8.0 + 4.0 * spread}, spread, random);
      const auto loose = loose_clumps(points, 1.0);
      for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(loose[i], i >= skin) << i;
    }
  }
}

TEST(LooseClumps, AreNoneOfAnEvenSkinBeItTornOrFullOfHoles) {
  RandomNumbers random(5);
  Points points = sheet(200.0, 100.0, random);
  EXPECT_EQ(loose_among(points, 1.0), 0);
  Points torn = points;
  std::erase_if(torn, [](const Vector3d& point) { return std::fmod(point.x(), 50.0) < 8.0; });
  EXPECT_EQ(loose_among(torn, 1.0), 0);
  for (int hole = 0; hole < 60; ++hole) {
    const Vector3d middle(random.uniform(0.0, 200.0), random.uniform(0.0, 100.0), 0.0);
    std::erase_if(points, [&](const Vector3d& point) { return (point - middle).norm() < 5.0; });
  }
  EXPECT_EQ(loose_among(points, 1.0), 0);
}

TEST(LooseClumps, AreNoneOfASideSeenAHundredTimesLessDensely) {
  RandomNumbers random(7);
  Points points = sheet(200.0, 200.0, random);
  std::erase_if(points, [&](const Vector3d& point) {
    return point.x() > 100.0 && random.uniform(0.0, 1.0) > 0.01;
  });
  EXPECT_EQ(loose_among(points, 1.0), 0);
}

// The first lines of a pointed shape are short, and skin.
TEST(LooseClumps, AreNoneOfAShapeInScannedLines) {
  Points points;
  for (double x = 0.5; x < 200.0; x += 5.0) {
    const double half = 40.0 * std::sqrt(x / 200.0);
    for (double y = -half; y < half; y += 0.25) points.emplace_back(x, y, 0.0);
  }
  EXPECT_EQ(loose_among(points, 0.5), 0);
}

TEST(LooseClumps, AreHeapsThoughOfManyPoints) {
  RandomNumbers random(13);
  for (const double spread : {0.7, 1.5, 3.0}) {
    Points points = sheet(100.0, 100.0, random);
    add_clump(points, 150, {50.0, 50.0, 8.0 + 4.0 * spread}, spread, random);
    EXPECT_GT(loose_among(points, 1.0), 140) << spread;
  }
}

// The lines of a scanner round a tip end in a small ring that is far from the next one.
TEST(LooseClumps, AreNoneOfATipInScannedLines) {
  constexpr double kRadius = 25.0;
  for (const double first : {0.02, 0.3}) {
    Points points;
    for (double down = first; down < 25.0; down += 1.5) {
      const double round = std::sqrt(2.0 * kRadius * down - down * down);
      const int count = static_cast<int>(2.0 * std::numbers::pi * round / 0.6) + 1;
      for (int i = 0; i < count; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / count;
        points.emplace_back(round * std::cos(turn), round * std::sin(turn), -down);
      }
    }
    EXPECT_EQ(loose_among(points, 1.0), 0) << first;
  }
}

// The end of a toe, seen apart from the rest.
TEST(LooseClumps, AreNoSheetsOfManyPoints) {
  RandomNumbers random(17);
  Points points = sheet(100.0, 100.0, random);
  for (int i = 0; i < 190; ++i) {
    const Vector3d way(random.normal(), random.normal(), random.normal());
    const Vector3d toe = 6.0 * way.normalized();
    if (toe.x() > 0.0) points.emplace_back(Vector3d(106.0, 50.0, 0.0) + toe);
  }
  EXPECT_EQ(loose_among(points, 1.0), 0);
}

TEST(LooseClumps, AreNoneOfFewPoints) {
  RandomNumbers random(11);
  Points points = sheet(100.0, 100.0, random);
  add_clump(points, 2, {50.0, 50.0, 20.0}, 1.0, random);
  EXPECT_EQ(loose_among(points, 1.0), 0);
  EXPECT_EQ(loose_among({}, 1.0), 0);
}

}  // namespace
}  // namespace instep
