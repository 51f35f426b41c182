#include "core/foot/skin/robust_extreme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace instep {
namespace {

using Eigen::Vector3d;

/// Points of a sphere about the origin, spread evenly (a spiral).
std::vector<Vector3d> sphere(double radius, double spacing) {
  const double area = 4.0 * std::numbers::pi * radius * radius;
  const auto count = static_cast<int>(area / (spacing * spacing));
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = 2.399963229728653 * i;
    const double ring = std::sqrt(1.0 - z * z);
    points.push_back(radius * Vector3d(ring * std::cos(angle), ring * std::sin(angle), z));
  }
  return points;
}

double normal_deviate(std::mt19937_64& generator) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(generator() >> 11) * 0x1p-53;
  return sum;
}

TEST(RobustExtreme, IsWithinAThirdOfAMillimetreOnHeelAndToe) {
  for (const double radius : {10.0, 30.0}) {
    for (const double spacing : {0.5, 1.0, 2.0}) {
      const auto points = sphere(radius, spacing);
      for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0.6, -0.8, 0)}) {
        EXPECT_NEAR(direction.dot(robust_extreme(points, direction)), radius, 0.3)
            << radius << " " << spacing;
      }
    }
  }
}

TEST(RobustExtreme, FindsTheSkinBetweenTheFarCornersOfACoarseMesh) {
  for (const double radius : {12.0, 30.0}) {
    const auto points = sphere(radius, 4.0);
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0.6, -0.8, 0)}) {
      EXPECT_NEAR(direction.dot(robust_extreme(points, direction)), radius, 0.15) << radius;
    }
  }
}

/// Of the toe of a foot of 2,500 points some ten show its front: their third was 1.2 mm short.
TEST(RobustExtreme, IsNotShortOfFewPointsAtRandom) {
  constexpr double kRadius = 10.0;
  std::mt19937_64 generator(11);
  double error = 0.0;
  double squares = 0.0;
  constexpr int kClouds = 400;
  for (int cloud = 0; cloud < kClouds; ++cloud) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 40; ++i) {
      const Vector3d way(normal_deviate(generator), normal_deviate(generator),
                         normal_deviate(generator));
      points.push_back(kRadius * way.normalized());
    }
    const double off = robust_extreme(points, Vector3d::UnitX()).x() - kRadius;
    error += off / kClouds;
    squares += off * off / kClouds;
  }
  EXPECT_NEAR(error, 0.0, 0.2);
  EXPECT_LT(std::sqrt(squares), 0.9);
}

TEST(RobustExtreme, IgnoresStraysBeforeFewPoints) {
  auto points = sphere(10.0, 4.0);
  const double clean = robust_extreme(points, Vector3d::UnitX()).x();
  points.emplace_back(25.0, 3.0, 1.0);
  EXPECT_NEAR(robust_extreme(points, Vector3d::UnitX()).x(), clean, 1.0);
  points.emplace_back(24.0, -2.0, 3.0);
  EXPECT_NEAR(robust_extreme(points, Vector3d::UnitX()).x(), clean, 1.0);
}

TEST(RobustExtreme, IgnoresTwoStrays) {
  auto points = sphere(30.0, 1.0);
  const double clean = robust_extreme(points, Vector3d::UnitX()).x();
  points.emplace_back(45.0, 3.0, 1.0);
  points.emplace_back(80.0, 0.0, 0.0);
  EXPECT_NEAR(robust_extreme(points, Vector3d::UnitX()).x(), clean, 0.2);
}

TEST(RobustExtreme, IsNotPulledOutwardsByNoise) {
  std::mt19937_64 generator(7);
  double sum = 0.0;
  constexpr int kClouds = 20;
  for (int cloud = 0; cloud < kClouds; ++cloud) {
    auto points = sphere(30.0, 1.0);
    for (auto& point : points) point *= 1.0 + 0.5 * normal_deviate(generator) / 30.0;
    sum += robust_extreme(points, Vector3d::UnitX()).x();
  }
  EXPECT_NEAR(sum / kClouds, 30.0, 0.3);
}

TEST(RobustExtreme, TakesWhatThereIsOfFewPoints) {
  EXPECT_EQ(robust_extreme({{1, 2, 3}}, Vector3d::UnitX()), Vector3d(1, 2, 3));
  EXPECT_EQ(robust_extreme({{1, 0, 0}, {2, 0, 0}, {9, 0, 0}}, Vector3d::UnitX()),
            Vector3d(2, 0, 0));
}

/// The start lay on the rim of the next patch or just off it, as the last bits were: toes of a last
/// moved by 2.4 mm.
TEST(RobustExtreme, DoesNotDependOnTheLastBitsOfPlaces) {
  std::mt19937_64 generator(4);
  for (int draw = 0; draw < 100; ++draw) {
    auto points = sphere(5.0, 1.0);
    for (auto& point : points) point *= 1.0 + 0.1 * normal_deviate(generator);
    const Vector3d found = robust_extreme(points, Vector3d::UnitX());
    for (const double scale : {1.0 + 3e-15, 1.0 - 5e-15, 1.0 + 1e-14}) {
      auto scaled = points;
      for (auto& point : scaled) point *= scale;
      EXPECT_LT((robust_extreme(scaled, Vector3d::UnitX()) - found).norm(), 1e-6) << draw;
    }
  }
}

}  // namespace
}  // namespace instep
