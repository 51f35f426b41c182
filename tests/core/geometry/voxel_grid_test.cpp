#include "core/geometry/voxel_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace instep {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> random_points(std::size_t count, double half_side) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-half_side, half_side);
  std::vector<Vector3d> points(count);
  for (auto& point : points) point = {uniform(random), uniform(random), uniform(random)};
  return points;
}

Eigen::Vector3i cell_of(const Vector3d& point, double cell_mm) {
  return (point / cell_mm).array().floor().cast<int>();
}

std::vector<std::size_t> cells_near(const VoxelGrid& grid, std::size_t cell) {
  std::vector<std::size_t> near;
  grid.each_near(cell, [&](std::size_t other) { near.push_back(other); });
  return near;
}

TEST(VoxelGrid, HoldsEveryPointOnceAmongThoseOfItsCell) {
  const auto points = random_points(500, 12);
  const VoxelGrid grid(points, 3.0);
  std::set<std::uint32_t> seen;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto home = cell_of(points[grid.members(cell)[0]], 3.0);
    for (const auto index : grid.members(cell)) {
      EXPECT_TRUE(seen.insert(index).second);
      EXPECT_EQ(cell_of(points[index], 3.0), home);
    }
  }
  EXPECT_EQ(seen.size(), points.size());
}

TEST(VoxelGrid, FindsTheSameNeighboursAsBruteForce) {
  const auto points = random_points(300, 10);
  const VoxelGrid grid(points, 3.0);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto home = cell_of(points[grid.members(cell)[0]], 3.0);
    std::vector<std::size_t> expected;
    for (std::size_t other = 0; other < grid.cell_count(); ++other) {
      const auto there = cell_of(points[grid.members(other)[0]], 3.0);
      if ((there - home).cwiseAbs().maxCoeff() <= 1) expected.push_back(other);
    }
    EXPECT_EQ(cells_near(grid, cell), expected);
  }
}

TEST(VoxelGrid, FindsTheSameFaceNeighboursAsBruteForce) {
  const auto points = random_points(300, 10);
  const VoxelGrid grid(points, 3.0);
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const auto home = cell_of(points[grid.members(cell)[0]], 3.0);
    std::vector<std::size_t> expected;
    for (std::size_t other = 0; other < grid.cell_count(); ++other) {
      const auto there = cell_of(points[grid.members(other)[0]], 3.0);
      if ((there - home).cwiseAbs().sum() <= 1) expected.push_back(other);
    }
    EXPECT_EQ(grid.face_neighbourhood(cell), expected);
  }
}

TEST(VoxelGrid, JoinsTouchingCellsIntoClustersOnly) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(0.9 * i, 0.9 * i, -0.9 * i);
  for (int i = 0; i < 50; ++i) points.emplace_back(0.9 * i + 5.0, 0.9 * i, -0.9 * i);
  const auto clusters = VoxelGrid(points, 1.0).clusters_of_points();
  EXPECT_EQ(std::count(clusters.begin(), clusters.end(), clusters.front()), 50);
  EXPECT_EQ(std::count(clusters.begin(), clusters.end(), clusters.back()), 50);
  EXPECT_NE(clusters.front(), clusters.back());
}

TEST(VoxelGrid, BearsNoPointsManyEqualPointsAndHugeCoordinates) {
  EXPECT_EQ(VoxelGrid({}, 1.0).cell_count(), 0U);
  EXPECT_TRUE(VoxelGrid({}, 1.0).clusters_of_points().empty());
  EXPECT_EQ(VoxelGrid(std::vector<Vector3d>(1000, Vector3d(1, 2, 3)), 1.0).cell_count(), 1U);
  const VoxelGrid far({{1e300, -1e300, 0}, {0, 0, 0}}, 1e-3);
  EXPECT_EQ(far.cell_count(), 2U);
  EXPECT_EQ(cells_near(far, 0).size(), 1U);
}

}  // namespace
}  // namespace instep
