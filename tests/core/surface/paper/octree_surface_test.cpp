#include "core/surface/paper/octree_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kRadius = 40.0;

/// Its axis is z, about that of least variance.
Points ring(std::size_t count, double unit = 1.0) {
  auto points = test::random_points(test::elliptic_cylinder(kRadius, kRadius), count, -6, 6, 0.0, 3)
                    .positions;
  for (auto& point : points) point *= unit;
  return points;
}

TEST(OctreeSurface, GoesThroughEveryPoint) {
  const auto surface = OctreeSurface::reconstruct(ring(2000));
  ASSERT_TRUE(surface) << surface.error().line();
  EXPECT_EQ(surface->points().size(), 2000U);
  for (const auto& point : surface->points()) {
    const auto value = surface->at(point);
    ASSERT_TRUE(value);
    EXPECT_NEAR(*value, 0.0, 1e-6);
  }
}

TEST(OctreeSurface, IsPositiveInsideAndNegativeOutsideOfADenseRing) {
  const auto surface = OctreeSurface::reconstruct(ring(8000));
  ASSERT_TRUE(surface);
  test::RandomNumbers random(4);
  int asked = 0;
  int right = 0;
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double offset = random.uniform(-0.3, 0.3);
    const double radius = kRadius + offset;
    const auto value = surface->at(
        {radius * std::cos(angle), radius * std::sin(angle), random.uniform(-4.0, 4.0)});
    if (!value) continue;
    ++asked;
    if ((*value > 0.0) == (offset < 0.0)) ++right;
  }
  EXPECT_GT(asked, 1500);
  EXPECT_GT(right, asked * 95 / 100);
}

TEST(OctreeSurface, ScalesWithTheUnit) {
  const auto in_millimetres = OctreeSurface::reconstruct(ring(1200));
  const auto in_metres = OctreeSurface::reconstruct(ring(1200, 1e-3));
  ASSERT_TRUE(in_millimetres && in_metres);
  EXPECT_NEAR(in_metres->longest_edge(), 1e-3 * in_millimetres->longest_edge(), 1e-12);
  for (const auto& place : {Vector3d(39, 0, 0), Vector3d(0, 41, 1), Vector3d(-28, 28, 2)}) {
    const auto wanted = in_millimetres->at(place);
    const auto value = in_metres->at(1e-3 * place);
    ASSERT_EQ(wanted.has_value(), value.has_value());
    if (wanted) {
      EXPECT_NEAR(1e3 * *value, *wanted, 1e-5);
    }
  }
}

TEST(OctreeSurface, IsNotDisturbedByDuplicates) {
  auto points = ring(1200);
  const auto plain = OctreeSurface::reconstruct(points);
  points.insert(points.end(), points.begin(), points.begin() + 300);
  for (int i = 0; i < 300; ++i) points.push_back(points[static_cast<std::size_t>(i)] * (1 + 1e-9));
  const auto surface = OctreeSurface::reconstruct(points);
  ASSERT_TRUE(plain && surface);
  EXPECT_EQ(surface->points(), plain->points());
}

TEST(OctreeSurface, RefusesPointsThatDetermineNone) {
  Points line;
  for (int i = 0; i < 5000; ++i) line.emplace_back(0.1 * i, 0.0, 0.0);
  for (const auto& points : {Points{}, Points{{1, 2, 3}}, Points(1000, Vector3d(1, 2, 3)),
                             Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, line}) {
    const auto surface = OctreeSurface::reconstruct(points);
    ASSERT_FALSE(surface) << points.size();
    EXPECT_EQ(surface.error().code, ErrorCode::kInsufficientData);
  }
}

TEST(OctreeSurface, TellsItsProgressUpToTheEnd) {
  double last = -1.0;
  ASSERT_TRUE(OctreeSurface::reconstruct(ring(1200), [&](double done) {
    EXPECT_GE(done, last);
    last = done;
  }));
  EXPECT_NEAR(last, 1.0, 1e-12);
}

}  // namespace
}  // namespace instep
