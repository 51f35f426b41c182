#include "core/girth/band/crowd_average.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

constexpr double kGrain = 0.04;

PlaneBand band_of(const OrientedPoints& points, double spacing, std::vector<bool> seen = {}) {
  seen.resize(points.size(), true);
  return {.middle_mm = {0, 0},
          .points = points,
          .index = PointIndex(test::positions_of(points)),
          .sources = {},
          .shares = {},
          .errors_mm = {},
          .seen = std::move(seen),
          .spacing = spacing,
          .grain = kGrain,
          .uneven = {},
          .scattered = {},
          .roughness = {}};
}

PlaneBand crowded(const OrientedPoints& points, std::vector<bool> seen = {}) {
  return band_of(points, 0.25 * kGrain, std::move(seen));
}

struct Moments {
  double certainty = 0.0;
  Vector3d place = Vector3d::Zero();
};

Moments moments_of(const OrientedPoints& points) {
  Moments sum;
  for (const auto& point : points) {
    sum.certainty += 1.0 / point.variance;
    sum.place += point.position / point.variance;
  }
  return sum;
}

TEST(CrowdAverage, WeighsPointsByTheirCertainty) {
  const OrientedPoints pair = {{{0.1, 0, 0}, Vector3d::UnitX(), 1e-6},
                               {{0.11, 0.004, 0}, Vector3d::UnitY(), 3e-6}};
  const auto average = average_crowds(crowded(pair));
  ASSERT_EQ(average.points.size(), 1U);
  const auto& mean = average.points.front();
  EXPECT_NEAR((mean.position - Vector3d(0.1025, 0.001, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((mean.normal - Vector3d(3, 1, 0).normalized()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(mean.variance, 0.75e-6, 1e-18);
}

TEST(CrowdAverage, KeepsPointsApartThatAreMoreThanHalfAGrainApart) {
  const auto count = [](double apart) {
    return average_crowds(crowded({{{0, 0, 0}, Vector3d::UnitZ(), 1.0},
                                   {{apart, 0, 0}, Vector3d::UnitZ(), 1.0}}))
        .points.size();
  };
  EXPECT_EQ(count(0.49 * kGrain), 1U);
  EXPECT_EQ(count(0.51 * kGrain), 2U);
}

TEST(CrowdAverage, LeavesPointsThatFaceApart) {
  const Vector3d up = Vector3d::UnitZ();
  const OrientedPoints thin = {{{0, 0, 0.004}, up, 1.0},
                               {{0, 0, -0.004}, -up, 1.0},
                               {{0.002, 0, 0.004}, up, 1.0},
                               {{0.002, 0, -0.004}, -up, 1.0}};
  const auto average = average_crowds(crowded(thin));
  ASSERT_EQ(average.points.size(), 2U);
  for (const auto& point : average.points) {
    EXPECT_NEAR((point.position - Vector3d(0.001, 0, 0.004 * point.normal.z())).norm(), 0.0, 1e-15);
    EXPECT_NEAR(point.variance, 0.5, 1e-15);
  }
  EXPECT_LT(average.points[0].normal.dot(average.points[1].normal), 0.0);
}

/// Each place has a point, a copy of it and another 0.4 grains off.
TEST(CrowdAverage, MergesOnlyCopiesWherePointsDoNotCrowd) {
  OrientedPoints points;
  for (int i = 0; i < 40; ++i) {
    for (const double off : {0.0, 1e-3 * kGrain, 0.4 * kGrain}) {
      points.push_back({{0.1 * i + off, 0.0, 0.0}, Vector3d::UnitZ(), 1.0});
    }
  }
  EXPECT_EQ(average_crowds(band_of(points, kGrain)).points.size(), 80U);
  EXPECT_EQ(average_crowds(band_of(points, 0.99 * kGrain)).points.size(), 40U);
}

TEST(CrowdAverage, LosesNoCertaintyAndMovesNoMiddle) {
  auto points = test::disc_points({0.1, 0, 0}, Vector3d::UnitZ(), 0.3, 3000, 0.001, 2);
  test::RandomNumbers random(3);
  for (auto& point : points) point.variance = random.uniform(1e-6, 1e-5);
  const auto average = average_crowds(crowded(points));
  // Discs of half a grain round places no nearer than that to each other cover the plane.
  EXPECT_LT(average.points.size(), points.size() / 3);
  EXPECT_GT(average.points.size(), std::pow(0.3 / (0.5 * kGrain), 2));
  const auto before = moments_of(points);
  const auto after = moments_of(average.points);
  EXPECT_NEAR(after.certainty, before.certainty, 1e-9 * before.certainty);
  EXPECT_NEAR((after.place - before.place).norm(), 0.0, 1e-9 * before.certainty);
}

TEST(CrowdAverage, WasSeenIfAnyOfItsPointsWas) {
  OrientedPoints points;
  for (int pair = 0; pair < 4; ++pair) {
    points.push_back({{0.2 * pair, 0, 0}, Vector3d::UnitZ(), 1.0});
    points.push_back({{0.2 * pair + 0.001, 0, 0}, Vector3d::UnitZ(), 1.0});
  }
  const auto average =
      average_crowds(crowded(points, {false, true, true, false, false, false, true, true}));
  EXPECT_EQ(average.points.size(), 4U);
  EXPECT_EQ(average.seen, std::vector<bool>({true, true, false, true}));
}

TEST(CrowdAverage, OfNothingIsNothing) {
  EXPECT_TRUE(average_crowds(crowded({})).points.empty());
}

}  // namespace
}  // namespace instep
