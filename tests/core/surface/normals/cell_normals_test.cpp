#include "core/surface/normals/cell_normals.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/prism_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/scanned_lines.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

CellNormals normals_of(const Points& points, double side, std::size_t fewest = 8) {
  return {PointIndex(points), side, 0.0, fewest};
}

void append(std::vector<OrientedPoint>& points, std::vector<OrientedPoint> more,
            const Vector3d& shift) {
  for (auto& point : more) {
    point.position += shift;
    points.push_back(point);
  }
}

/// How many points get a normal that does not point out of the body.
std::size_t wrong_after_orienting(const std::vector<OrientedPoint>& points, double side) {
  auto cells = normals_of(test::positions_of(points), side);
  cells.orient_by_neighbours();
  const auto normals = cells.of_points();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (normals[i].dot(points[i].normal) < 0.0) ++wrong;
  }
  return wrong;
}

/// The cube of cells of side `side` round the origin's grid that holds a place.
Eigen::Array3d cell_of(const Vector3d& place, double side) {
  return (place / side).array().floor();
}

TEST(CellNormals, AreTheSmallestAxesOfTheCellAndThoseRoundIt) {
  const double side = 0.1;
  const auto points = test::positions_of(test::sphere_points(0.5, 1500, 0.01, 1));
  const auto normals = normals_of(points, side, 4).of_points();
  ASSERT_EQ(normals.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Points round;
    for (const auto& point : points) {
      const Eigen::Array3d off = cell_of(point, side) - cell_of(points[i], side);
      if (off.abs().maxCoeff() < 1.5) round.push_back(point);
    }
    Vector3d mean = Vector3d::Zero();
    for (const auto& point : round) mean += point / static_cast<double>(round.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto& point : round) spread += (point - mean) * (point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    EXPECT_NEAR(std::abs(normals[i].dot(axes.eigenvectors().col(0))), 1.0, 1e-9);
  }
}

TEST(CellNormals, AskTheNearestPointsWhereCellsHoldFew) {
  const auto points = test::sphere_points(0.5, 400, 0.0, 2);
  const auto normals = normals_of(test::positions_of(points), 1e-3, 10).of_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(std::abs(normals[i].dot(points[i].normal)), 0.95);
  }
}

TEST(CellNormals, OfAPlaneAreItsNormalHoweverFarFromTheOrigin) {
  const Vector3d normal = Vector3d(1, 2, -2) / 3.0;
  const auto points =
      test::positions_of(test::disc_points({30000, 50, 20}, normal, 10.0, 500, 0.0, 2));
  for (const auto& found : normals_of(points, 1.0).of_points()) {
    EXPECT_NEAR(std::abs(found.dot(normal)), 1.0, 1e-9);
  }
}

TEST(CellNormals, OfADenseSpherePointAlongItsRadii) {
  const auto points = test::sphere_points(40.0, 5000, 0.0, 3);
  const auto normals = normals_of(test::positions_of(points), 3.0).of_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(std::abs(normals[i].dot(points[i].normal)), 0.995);
  }
}

TEST(CellNormals, AreFiniteUnitVectorsForAnything) {
  Points line;
  for (int i = 0; i < 40; ++i) line.emplace_back(i, 2 * i, 0.0);
  for (const auto& points : {line, Points(20, Vector3d(1, 2, 3)), Points{{1, 2, 3}},
                             Points{{0, 0, 0}, {1, 0, 0}}, Points{}}) {
    auto cells = normals_of(points, 1.0);
    cells.orient_by_neighbours();
    const auto normals = cells.of_points();
    ASSERT_EQ(normals.size(), points.size());
    for (const auto& normal : normals) EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
  }
}

TEST(CellNormals, AreTurnedOutOfTheBody) {
  EXPECT_EQ(wrong_after_orienting(test::sphere_points(0.5, 3000, 0.0, 4), 0.05), 0U);
  EXPECT_EQ(wrong_after_orienting(test::sphere_points(0.5, 3000, 0.002, 6), 0.05), 0U);
}

/// The walls' own normals are square to each other and agree with either sign: only those of cells
/// at the edges lead from one wall to the next.
TEST(CellNormals, FindTheirWayRoundASquarePrism) {
  EXPECT_EQ(wrong_after_orienting(test::prism_points(1.0, 0.5, 0.04, 0.002, 8), 0.06), 0U);
}

/// Of a prism 100 across, in a unit in which it is one.
std::vector<OrientedPoint> faced_points(const test::PrismCorners& corners, int count) {
  const PointCloud cloud = test::faced_prism_points(corners, count, 3);
  std::vector<OrientedPoint> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    points.push_back({0.01 * cloud.positions[i], cloud.normals[i], 0.0});
  }
  return points;
}

/// One normal for both walls of a cell pointed into the body on one of them, and walls that met in
/// less than 50 degrees were turned alike.
TEST(CellNormals, PointOutOfBothWallsOfAThinPart) {
  for (const double degrees : {20.0, 30.0, 45.0}) {
    EXPECT_LE(wrong_after_orienting(faced_points(test::rhombus(degrees, 50.0), 2000), 0.035), 10U)
        << degrees;
  }
  const test::PrismCorners plate = {{-50, -2}, {50, -2}, {50, 2}, {-50, 2}};
  EXPECT_LE(wrong_after_orienting(faced_points(plate, 2000), 0.035), 10U);
}

TEST(CellNormals, DoNotMindWhereTheBodyStandsNorItsUnit) {
  std::vector<OrientedPoint> body;
  append(body, test::sphere_points(0.5, 2000, 0.002, 10), {300.0, -200.0, 40.0});
  EXPECT_EQ(wrong_after_orienting(body, 0.06), 0U);
  EXPECT_EQ(wrong_after_orienting(test::scaled(body, 1e3), 60.0), 0U);
}

TEST(CellNormals, OfTwoBodiesAreEachTurnedOutwards) {
  std::vector<OrientedPoint> bodies;
  append(bodies, test::sphere_points(0.5, 2000, 0.0, 13), {-4.0, 0.0, 0.0});
  append(bodies, test::sphere_points(0.5, 2000, 0.0, 14), {4.0, 0.0, 0.0});
  EXPECT_EQ(wrong_after_orienting(bodies, 0.06), 0U);
}

TEST(CellNormals, OrderOfPointsDoesNotMatter) {
  const auto points = test::sphere_points(0.5, 2000, 0.0, 16);
  EXPECT_EQ(wrong_after_orienting(test::in_another_order(points, 17), 0.06), 0U);
}

/// A line is as thick as its noise, or bends in a plane of its own: what lies on it alone faces
/// anywhere.
TEST(CellNormals, OfPointsOnLinesAreMadeOfSeveralLines) {
  for (const bool round : {true, false}) {
    for (const double sigma : {0.0, 0.4}) {
      auto positions = test::ScannedLines{40, 40, round, 8.0, 0.5, sigma}.positions(1);
      for (auto& place : positions) place /= 80.0;
      const auto normals = normals_of(positions, 0.03, 16).of_points();
      double squares = 0.0;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vector3d outward = Vector3d(positions[i].x(), positions[i].y(), 0.0).normalized();
        squares += normals[i].cross(outward).squaredNorm();
      }
      EXPECT_LT(std::sqrt(squares / static_cast<double>(positions.size())), 0.15)
          << round << " " << sigma;
    }
  }
}

}  // namespace
}  // namespace instep
