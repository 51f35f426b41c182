#include "core/geometry/strays/stray_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/point_spacing.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t kEighth = 8;

/// All points by their distance from one of them, which comes first.
std::vector<std::size_t> by_distance(const Points& points, std::size_t from) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(kEighth + 1);
  std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
    return (points[a] - points[from]).squaredNorm() < (points[b] - points[from]).squaredNorm();
  });
  return {order.begin(), end};
}

/// The definition, asked of every point by looking at all others.
std::vector<bool> strays_by_definition(const Points& points) {
  std::vector<std::vector<std::size_t>> nearest;
  std::vector<double> reach;
  for (std::size_t i = 0; i < points.size(); ++i) {
    nearest.push_back(by_distance(points, i));
    reach.push_back((points[nearest[i][kEighth]] - points[i]).norm());
  }
  std::vector<bool> strays;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> around;
    for (const auto j : nearest[i]) around.push_back(reach[j]);
    std::sort(around.begin(), around.end());
    strays.push_back(reach[i] > 2.2 * around[around.size() / 2]);
  }
  return strays;
}

/// Even over a sphere of radius one, 0.1 apart, with some off by five to forty spacings.
Points sphere_with_strays(std::size_t strays, std::uint64_t seed) {
  Points points = test::positions_of(test::sphere_points(1.0, 1200, 0.003, seed));
  test::RandomNumbers random(seed + 100);
  for (std::size_t i = 0; i < strays; ++i) {
    const Vector3d way(random.normal(), random.normal(), random.normal());
    points.push_back(random.uniform(1.5, 5.0) * way.normalized());
  }
  return points;
}

TEST(StrayPoints, AreThoseOfTheDefinitionWhereTheyLieFarOff) {
  for (const std::size_t strays : {0U, 1U, 5U, 20U}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const Points points = sphere_with_strays(strays, seed);
      const PointIndex index(points);
      const auto found = stray_points(index, usual_spacing(index, 200));
      EXPECT_EQ(found, strays_by_definition(points)) << strays << " strays, seed " << seed;
      const auto count = static_cast<std::size_t>(std::count(found.begin(), found.end(), true));
      EXPECT_LE(count, strays);
      EXPECT_GE(2 * count, strays) << "of " << strays;
    }
  }
}

/// Up to four together each have more of the surface than of their own kind for neighbours.
TEST(StrayPoints, AreThoseOfTheDefinitionWhereAFewStandTogether) {
  for (const std::size_t together : {2U, 3U, 4U, 5U, 9U, 12U}) {
    Points points = sphere_with_strays(0, 7);
    const std::size_t surface = points.size();
    test::RandomNumbers random(8);
    for (const Vector3d& place : {Vector3d(2, 0, 0), Vector3d(0, -1.6, 1), Vector3d(-1, 2, 3)}) {
      for (std::size_t i = 0; i < together; ++i) {
        const Vector3d off(random.normal(), random.normal(), random.normal());
        points.push_back(place + 0.02 * off);
      }
    }
    const PointIndex index(points);
    const auto found = stray_points(index, usual_spacing(index, 200));
    EXPECT_EQ(found, strays_by_definition(points)) << together << " together";
    if (together > 4) continue;
    for (std::size_t i = surface; i < points.size(); ++i) EXPECT_TRUE(found[i]) << together;
  }
}

TEST(StrayPoints, AreNoneOnASurfaceWhoseSpacingGrowsSlowly) {
  test::RandomNumbers random(4);
  Points points;
  for (int i = 0; i < 1500; ++i) {
    const double reach = std::pow(random.uniform(), 2);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    points.emplace_back(reach * std::cos(angle), reach * std::sin(angle), 0.0);
  }
  const PointIndex index(points);
  const auto by_definition = strays_by_definition(points);
  EXPECT_LT(std::count(by_definition.begin(), by_definition.end(), true), 15);
  const auto found = stray_points(index, usual_spacing(index, 200));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(found[i], by_definition[i]) << "point " << i << " does not stand alone";
  }
}

TEST(StrayPoints, DoNotDependOnTheUnit) {
  Points points = sphere_with_strays(12, 5);
  const PointIndex index(points);
  const double spacing = usual_spacing(index, 200);
  const auto before = stray_points(index, spacing);
  for (auto& point : points) point *= 1024.0;
  const PointIndex larger(points);
  EXPECT_DOUBLE_EQ(usual_spacing(larger, 200), 1024.0 * spacing);
  EXPECT_EQ(stray_points(larger, 1024.0 * spacing), before);
}

}  // namespace
}  // namespace instep
