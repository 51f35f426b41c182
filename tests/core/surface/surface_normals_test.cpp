#include "core/surface/surface_normals.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Every other one turned inwards, at random.
Points shaken(Points normals, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  for (auto& normal : normals) {
    if (random.below(2) == 0) normal = -normal;
  }
  return normals;
}

void append(std::vector<OrientedPoint>& points, std::vector<OrientedPoint> more,
            const Vector3d& shift) {
  for (auto& point : more) {
    point.position += shift;
    points.push_back(point);
  }
}

/// How many normals do not point the way they should.
std::size_t wrong_after_orienting(const std::vector<OrientedPoint>& points, std::uint64_t seed) {
  const auto positions = test::positions_of(points);
  Points normals;
  for (const auto& point : points) normals.push_back(point.normal);
  normals = shaken(normals, seed);
  orient_by_neighbours(positions, PointIndex(positions), normals);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::abs(normals[i].dot(points[i].normal)) < 1.0 - 1e-12) ADD_FAILURE() << "bent a normal";
    if (normals[i].dot(points[i].normal) < 0.0) ++wrong;
  }
  return wrong;
}

TEST(SurfaceNormals, AreTheSmallestAxesOfTheNeighbours) {
  const auto points = test::positions_of(test::sphere_points(0.5, 300, 0.01, 1));
  for (const std::size_t count : {5U, 12U, 30U}) {
    const auto normals = estimate_normals(points, PointIndex(points), count);
    ASSERT_EQ(normals.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      auto nearest = points;
      std::sort(nearest.begin(), nearest.end(), [&](const Vector3d& a, const Vector3d& b) {
        return (a - points[i]).squaredNorm() < (b - points[i]).squaredNorm();
      });
      nearest.resize(count);
      Vector3d mean = Vector3d::Zero();
      for (const auto& point : nearest) mean += point / static_cast<double>(count);
      Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
      for (const auto& point : nearest) spread += (point - mean) * (point - mean).transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
      EXPECT_NEAR(std::abs(normals[i].dot(axes.eigenvectors().col(0))), 1.0, 1e-9);
    }
  }
}

TEST(SurfaceNormals, OfAPlaneAreItsNormal) {
  const Vector3d normal = Vector3d(1, 2, -2) / 3.0;
  const auto points =
      test::positions_of(test::disc_points({100, 50, 20}, normal, 10.0, 500, 0.0, 2));
  for (const auto& found : estimate_normals(points, PointIndex(points), 12)) {
    EXPECT_NEAR(std::abs(found.dot(normal)), 1.0, 1e-9);
  }
}

TEST(SurfaceNormals, OfADenseSpherePointAlongItsRadii) {
  const auto points = test::positions_of(test::sphere_points(40.0, 5000, 0.0, 3));
  const auto normals = estimate_normals(points, PointIndex(points), 10);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(std::abs(normals[i].dot(points[i].normalized())), 0.999);
  }
}

TEST(SurfaceNormals, AreFiniteUnitVectorsForAnything) {
  Points line;
  for (int i = 0; i < 40; ++i) line.emplace_back(i, 2 * i, 0.0);
  for (const auto& points : {line, Points(20, Vector3d(1, 2, 3)), Points{{1, 2, 3}},
                             Points{{0, 0, 0}, {1, 0, 0}}, Points{}}) {
    auto normals = estimate_normals(points, PointIndex(points), 8);
    ASSERT_EQ(normals.size(), points.size());
    orient_by_neighbours(points, PointIndex(points), normals);
    for (const auto& normal : normals) EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
  }
}

TEST(OrientByNeighbours, TurnsAllNormalsOutOfTheBody) {
  EXPECT_EQ(wrong_after_orienting(test::sphere_points(0.5, 3000, 0.0, 4), 5), 0U);
  EXPECT_EQ(wrong_after_orienting(test::sphere_points(0.5, 3000, 0.002, 6), 7), 0U);
}

/// At the edges, only normals estimated over them lead from one wall to the next: the walls' own
/// are square to each other, and agree with either sign.
TEST(OrientByNeighbours, FindsItsWayRoundASquarePrism) {
  const auto points = test::prism_points(1.0, 0.5, 0.04, 0.002, 8);
  const auto positions = test::positions_of(points);
  const PointIndex index(positions);
  auto normals = shaken(estimate_normals(positions, index, 10), 9);
  orient_by_neighbours(positions, index, normals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(normals[i].dot(points[i].normal), 0.1) << positions[i].transpose();
  }
}

TEST(OrientByNeighbours, DoesNotMindWhereTheBodyStandsNorItsUnit) {
  std::vector<OrientedPoint> body;
  append(body, test::sphere_points(0.5, 2000, 0.002, 10), {300.0, -200.0, 40.0});
  EXPECT_EQ(wrong_after_orienting(body, 11), 0U);
  EXPECT_EQ(wrong_after_orienting(test::scaled(body, 1e3), 12), 0U);
}

TEST(OrientByNeighbours, TurnsEachOfTwoBodiesOutwards) {
  std::vector<OrientedPoint> bodies;
  append(bodies, test::sphere_points(0.5, 2000, 0.0, 13), {-4.0, 0.0, 0.0});
  append(bodies, test::sphere_points(0.5, 2000, 0.0, 14), {4.0, 0.0, 0.0});
  EXPECT_EQ(wrong_after_orienting(bodies, 15), 0U);
}

TEST(OrientByNeighbours, OrderOfPointsDoesNotMatter) {
  const auto points = test::sphere_points(0.5, 2000, 0.0, 16);
  EXPECT_EQ(wrong_after_orienting(test::in_another_order(points, 17), 18), 0U);
}

}  // namespace
}  // namespace instep
