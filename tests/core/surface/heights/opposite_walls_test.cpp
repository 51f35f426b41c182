#include "core/surface/heights/opposite_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Points by turns on either of two squares of side one over each other, `apart` in the middle,
/// that meet, or would, in an angle of that many degrees; with noise across them.
Points two_walls(double apart, double degrees, double sigma, std::size_t count,
                 std::uint64_t seed) {
  test::RandomNumbers random(seed);
  const double slope = std::tan(0.5 * degrees * std::numbers::pi / 180.0);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-0.5, 0.5);
    const double half = 0.5 * apart - slope * x + sigma * random.normal();
    const double z = random.uniform(-0.5, 0.5);
    points.emplace_back(x, i % 2 == 0 ? half : -half, z);
  }
  return points;
}

/// In how many of 100 draws they are told apart, every point rightly.
int told_apart(double apart, double degrees, double sigma, std::size_t count) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto points = two_walls(apart, degrees, sigma, count, seed);
    const auto walls = OppositeWalls::among(points);
    if (!walls) continue;
    bool all = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
      all = all && (walls->sides[i] == walls->sides.front()) == (i % 2 == 0);
    }
    right += all;
  }
  return right;
}

TEST(OppositeWalls, OfAPlateAreToldApart) {
  EXPECT_GE(told_apart(0.2, 0.0, 0.0, 20), 85);
  EXPECT_GE(told_apart(0.2, 0.0, 0.0, 60), 99);
  EXPECT_GE(told_apart(0.2, 0.0, 0.01, 60), 99);
}

/// To the edge in which they meet, in the middle of one side of the squares.
TEST(OppositeWalls, OfAWedgeAreToldApart) {
  for (const double degrees : {15.0, 30.0, 45.0}) {
    const double apart = std::tan(0.5 * degrees * std::numbers::pi / 180.0);
    EXPECT_GE(told_apart(apart, degrees, 0.0, 80), 90) << degrees;
  }
}

TEST(OppositeWalls, AreTheirPlanes) {
  const auto points = two_walls(0.3, 30.0, 0.0, 60, 1);
  const auto walls = OppositeWalls::among(points);
  ASSERT_TRUE(walls);
  const auto& [first, second] = walls->both;
  EXPECT_NEAR(std::abs(first.normal.dot(second.normal)), std::cos(std::numbers::pi / 6.0), 1e-9);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(walls->both[walls->sides[i]].distance(points[i]), 0.0, 1e-9) << i;
  }
}

TEST(OppositeWalls, AreHardlyEverSeenInOneNoisySheet) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    seen += OppositeWalls::among(two_walls(0.0, 0.0, 0.1, 12 + seed % 50, seed)).has_value();
  }
  EXPECT_LE(seen, 2);
}

/// Two planes explain all of it, but lie beside each other.
TEST(OppositeWalls, AreNotTheSidesOfARoofNorThoseOfABend) {
  test::RandomNumbers random(4);
  for (int draw = 0; draw < 50; ++draw) {
    Points roof;
    Points bend;
    for (int i = 0; i < 40; ++i) {
      const double x = random.uniform(-0.5, 0.5);
      const double z = random.uniform(-0.5, 0.5);
      roof.emplace_back(x, -0.4 * std::abs(x), z);
      bend.emplace_back(x, -0.8 * x * x, z);
    }
    EXPECT_FALSE(OppositeWalls::among(roof)) << draw;
    EXPECT_FALSE(OppositeWalls::among(bend)) << draw;
  }
}

TEST(OppositeWalls, AreNotTwoLinesNorAFewPoints) {
  Points lines;
  for (int i = 0; i < 20; ++i) {
    lines.emplace_back(0.05 * i, 0.1, 0.0);
    lines.emplace_back(0.05 * i, -0.1, 0.0);
  }
  EXPECT_FALSE(OppositeWalls::among(lines));
  EXPECT_FALSE(OppositeWalls::among(two_walls(0.2, 0.0, 0.0, 10, 1)));
  EXPECT_FALSE(OppositeWalls::among(Points(40, Vector3d(1.0, 2.0, 3.0))));
}

/// Each lies on a plane of its own.
TEST(OppositeWalls, AreNotTwoLevelRowsRoundAnEdge) {
  Points rows;
  for (int i = 0; i < 12; ++i) {
    for (const double height : {-0.1, 0.1}) {
      rows.emplace_back(0.08 * i, 0.0, height);
      rows.emplace_back(0.0, 0.08 * i, height);
    }
  }
  EXPECT_FALSE(OppositeWalls::among(rows));
}

}  // namespace
}  // namespace instep
