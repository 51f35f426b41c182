#include "core/surface/mesh/grown_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>

#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> on_sphere(std::size_t count, double radius, const Vector3d& centre,
                                std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector3d> points;
  while (points.size() < count) {
    const Vector3d place(random.normal(), random.normal(), random.normal());
    points.push_back(centre + radius * place.normalized());
  }
  return points;
}

std::vector<Vector3d> in_square(std::size_t count, double side, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(0, side), random.uniform(0, side), 0.0);
  }
  return points;
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& origin = mesh.positions[a];
    sum += 0.5 * (mesh.positions[b] - origin).cross(mesh.positions[c] - origin).norm();
  }
  return sum;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c])) / 6.0;
  }
  return std::abs(sum);
}

/// Corners - edges + triangles, and edges that belong to one triangle only.
struct Topology {
  int characteristic = 0;
  int border = 0;
};

/// Also expects that no directed edge is used twice.
Topology topology(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::set<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners.insert(triangle[k]);
      EXPECT_EQ(++edges[std::pair(triangle[k], triangle[(k + 1) % 3])], 1);
    }
  }
  int count = 0;
  Topology result;
  for (const auto& [edge, times] : edges) {
    const bool has_other = edges.count({edge.second, edge.first}) > 0;
    if (!has_other) ++result.border;
    if (!has_other || edge.first < edge.second) ++count;
  }
  result.characteristic =
      static_cast<int>(corners.size()) - count + static_cast<int>(mesh.triangles.size());
  return result;
}

TEST(GrownMesh, ClosesASphere) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto mesh = grow_mesh(on_sphere(3000, 40, Vector3d::Zero(), seed));
    const auto [characteristic, border] = topology(mesh);
    EXPECT_EQ(characteristic, 2);
    EXPECT_EQ(border, 0);
    EXPECT_EQ(mesh.triangles.size(), 2U * 3000 - 4) << "a triangulation of all points";
    EXPECT_NEAR(area(mesh) / (4 * std::numbers::pi * 1600), 1.0, 0.01);
    EXPECT_NEAR(volume(mesh) / (4.0 / 3.0 * std::numbers::pi * 64000), 1.0, 0.01);
  }
}

TEST(GrownMesh, CoversAFlatPatchOnce) {
  const auto mesh = grow_mesh(in_square(2000, 100, 4));
  EXPECT_EQ(topology(mesh).characteristic, 1);
  EXPECT_LE(area(mesh), 10000.0);
  EXPECT_GT(area(mesh), 9700.0);
}

TEST(GrownMesh, CoversALatticeWhoseDiagonalsAreUndecided) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 21; ++i) {
    for (int k = 0; k < 21; ++k) points.emplace_back(i, k, 0);
  }
  const auto mesh = grow_mesh(points);
  EXPECT_EQ(topology(mesh).characteristic, 1);
  EXPECT_NEAR(area(mesh), 400.0, 1e-9);
}

TEST(GrownMesh, FollowsTheSharpEdgesOfABox) {
  auto points = in_square(1500, 50, 9);
  for (auto& point : in_square(1500, 50, 10)) points.emplace_back(point.x(), point.y(), 50);
  for (auto& point : in_square(1500, 50, 11)) points.emplace_back(0, point.x(), point.y());
  for (auto& point : in_square(1500, 50, 12)) points.emplace_back(50, point.x(), point.y());
  for (auto& point : in_square(1500, 50, 13)) points.emplace_back(point.x(), 0, point.y());
  for (auto& point : in_square(1500, 50, 14)) points.emplace_back(point.x(), 50, point.y());
  const auto mesh = grow_mesh(points);
  EXPECT_NEAR(area(mesh) / 15000, 1.0, 0.02);
  EXPECT_LT(topology(mesh).border, 27) << "a thousandth of the edges";
}

TEST(GrownMesh, KeepsSeparateBodiesApart) {
  auto points = on_sphere(1500, 20, {0, 0, 0}, 1);
  for (const auto& point : on_sphere(1500, 20, {44, 0, 0}, 2)) points.push_back(point);
  const auto mesh = grow_mesh(points);
  for (const auto& [a, b, c] : mesh.triangles) {
    EXPECT_EQ(a < 1500, b < 1500);
    EXPECT_EQ(a < 1500, c < 1500);
  }
  EXPECT_EQ(topology(mesh).characteristic, 4);
  EXPECT_EQ(topology(mesh).border, 0);
}

TEST(GrownMesh, LeavesAWideHoleOpen) {
  std::vector<Vector3d> points;
  for (const auto& point : in_square(4000, 100, 4)) {
    if ((point - Vector3d(50, 50, 0)).norm() > 15.0) points.push_back(point);
  }
  const auto mesh = grow_mesh(points);
  EXPECT_EQ(topology(mesh).characteristic, 0) << "a ring";
  EXPECT_NEAR(area(mesh), 10000 - 225 * std::numbers::pi, 300.0) << "the rim is ragged";
}

TEST(GrownMesh, UsesOnePointOfEachPlace) {
  const auto once = in_square(500, 100, 4);
  auto thrice = once;
  for (int i = 0; i < 2; ++i) thrice.insert(thrice.end(), once.begin(), once.end());
  EXPECT_EQ(grow_mesh(thrice).triangles, grow_mesh(once).triangles);
  EXPECT_EQ(grow_mesh(thrice).positions, thrice);
}

TEST(GrownMesh, IsTheSameInAnyUnit) {
  const auto points = on_sphere(800, 40, {1, 2, 3}, 1);
  auto larger = points;
  for (auto& point : larger) point *= 1024.0;
  EXPECT_EQ(grow_mesh(larger).triangles, grow_mesh(points).triangles);
}

TEST(GrownMesh, HasNoTriangleWhereThereIsNoSurface) {
  EXPECT_TRUE(grow_mesh({}).empty());
  EXPECT_TRUE(grow_mesh({{1, 2, 3}, {4, 5, 6}}).empty());
  EXPECT_TRUE(grow_mesh(std::vector<Vector3d>(500, Vector3d(1, 2, 3))).empty());
  std::vector<Vector3d> line;
  for (int i = 0; i < 500; ++i) line.emplace_back(i, 2.0 * i, -3.0 * i);
  EXPECT_TRUE(grow_mesh(line).empty());
}

TEST(GrownMesh, IsTheTriangleOfThreePoints) {
  EXPECT_EQ(grow_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 1U);
}

TEST(GrownMesh, EndsOnACrowdWithoutASurface) {
  test::RandomNumbers random(1);
  std::vector<Vector3d> crowd;
  for (int i = 0; i < 5000; ++i) {
    crowd.emplace_back(random.normal(), random.normal(), random.normal());
  }
  const auto mesh = grow_mesh(crowd);
  topology(mesh);
  EXPECT_LT(mesh.triangles.size(), 2U * crowd.size());
}

}  // namespace
}  // namespace instep
