#include "core/surface/paper/box_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/inverse_power.h"
#include "core/geometry/principal_frame.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points cylinder(std::size_t count, double low, double high) {
  return test::random_points(test::elliptic_cylinder(40, 40), count, low, high, 0.0, 3).positions;
}

TEST(BoxNormals, SizeIsTheCubeRootOfVolumeOverCount) {
  const Points points = {{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {0, 0, 6},
                         {4, 5, 6}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_NEAR(neighbourhood_box_size(points), std::cbrt(4.0 * 5.0 * 6.0 / 8.0), 1e-12);
}

TEST(BoxNormals, SizeOfAFlatGridIsItsSpacing) {
  Points grid;
  for (int i = 0; i < 400; ++i) grid.emplace_back(3.0 * (i % 20), 3.0 * (i / 20), 5.0);
  EXPECT_NEAR(neighbourhood_box_size(grid), 3.0, 0.2);
  EXPECT_EQ(neighbourhood_box_size({{1, 1, 1}, {1, 1, 1}}), 0.0);
}

/// The paper's own words, point by point: the six boxes round each point's box, by their numbers.
TEST(BoxNormals, AreThoseOfTheSevenBoxesRoundEachPoint) {
  const auto points = cylinder(600, -6, 6);
  const auto normals = box_normals(points);
  Vector3d corner = points[0];
  for (const auto& point : points) corner = corner.cwiseMin(point);
  const double size = neighbourhood_box_size(points);
  const auto box_of = [&](const Vector3d& point) {
    return Eigen::Vector3i(((point - corner) / size).array().floor().cast<int>());
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    Points neighbours;
    for (const auto& other : points) {
      if ((box_of(other) - box_of(points[i])).cwiseAbs().sum() <= 1) neighbours.push_back(other);
    }
    const Vector3d expected = smallest_axis(spread_of(neighbours).covariance);
    EXPECT_NEAR(std::abs(normals[i].dot(expected)), 1.0, 1e-9);
  }
}

TEST(BoxNormals, PointOutOfADenseRing) {
  const auto points = cylinder(8000, -6, 6);
  const auto normals = box_normals(points);
  std::size_t right = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d outward(points[i].x() / 40.0, points[i].y() / 40.0, 0.0);
    if (normals[i].dot(outward) > 0.9) ++right;
  }
  EXPECT_GT(right, points.size() * 99 / 100);
}

TEST(BoxNormals, AreFiniteUnitVectorsForAnything) {
  Points flat;
  for (int i = 0; i < 100; ++i) flat.emplace_back(i % 10, i / 10, 0.0);
  for (const auto& points : {flat, Points{{1, 2, 3}}, Points(5, Vector3d(1, 2, 3)),
                             Points{{0, 0, 0}, {1, 0, 0}, {1e5, 0, 0}}}) {
    for (const auto& normal : box_normals(points)) EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
  }
}

TEST(BoxNormals, OfAnExactPlaneAreUprightWhereABoxHasEnoughPoints) {
  test::RandomNumbers random(2);
  Points flat;
  for (int i = 0; i < 3000; ++i) {
    flat.emplace_back(random.uniform(0, 50), random.uniform(0, 50), 7.0);
  }
  const auto normals = box_normals(flat);
  const auto upright = std::count_if(normals.begin(), normals.end(), [](const auto& normal) {
    return std::abs(normal.z()) > 1.0 - 1e-9;
  });
  EXPECT_GT(upright, 2700);
}

}  // namespace
}  // namespace instep
