#include "core/surface/paper/constrained_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "tests/support/analytic_shapes.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double kRadius = 40.0;
constexpr double kHalfHeight = 10.0;

/// A ring of a cylinder, turned and moved; and back.
const RigidTransform& turned() {
  static const RigidTransform transform = Eigen::Translation3d(300, -200, 50) *
                                          Eigen::AngleAxisd(0.8, Vector3d(1, 2, 0.5).normalized());
  return transform;
}

Points ring(std::size_t count) {
  auto points = test::random_points(test::elliptic_cylinder(kRadius, kRadius), count, -kHalfHeight,
                                    kHalfHeight, 0.0, 7)
                    .positions;
  for (auto& point : points) point = turned() * point;
  return points;
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& corners : mesh.triangles) {
    const Vector3d& a = mesh.positions[corners[0]];
    sum += 0.5 * (mesh.positions[corners[1]] - a).cross(mesh.positions[corners[2]] - a).norm();
  }
  return sum;
}

TEST(ConstrainedSurface, LiesOnTheCylinderAndEndsWhereThePointsDo) {
  const auto mesh = constrained_surface(ring(6000));
  ASSERT_TRUE(mesh) << mesh.error().line();
  std::size_t near = 0;
  for (const auto& position : mesh->positions) {
    const Vector3d place = turned().inverse() * position;
    EXPECT_LT(std::abs(place.z()), kHalfHeight + 1.5);
    if (std::abs(place.head<2>().norm() - kRadius) < 0.1) ++near;
  }
  EXPECT_GT(near, mesh->positions.size() * 97 / 100);
  EXPECT_NEAR(area(*mesh), 2.0 * M_PI * kRadius * 2.0 * kHalfHeight, 0.05 * 5026.0);
}

TEST(ConstrainedSurface, FacesOutwards) {
  const auto mesh = constrained_surface(ring(6000));
  ASSERT_TRUE(mesh);
  std::size_t outward = 0;
  for (const auto& corners : mesh->triangles) {
    const Vector3d a = turned().inverse() * mesh->positions[corners[0]];
    const Vector3d b = turned().inverse() * mesh->positions[corners[1]];
    const Vector3d c = turned().inverse() * mesh->positions[corners[2]];
    if ((b - a).cross(c - a).head<2>().dot(a.head<2>()) >= 0.0) ++outward;
  }
  EXPECT_GT(outward, mesh->triangles.size() * 95 / 100);
}

TEST(ConstrainedSurface, SmallerCubesGiveMoreTriangles) {
  ConstrainedSurfaceOptions options;
  options.cube_mm = 2.0;
  const auto coarse = constrained_surface(ring(3000), options);
  options.cube_mm = 1.0;
  const auto fine = constrained_surface(ring(3000), options);
  ASSERT_TRUE(coarse && fine);
  EXPECT_GT(fine->triangles.size(), 3 * coarse->triangles.size());
}

TEST(ConstrainedSurface, RefusesWhatHasNoSurface) {
  const auto code = [](const Points& points, std::optional<double> cube_mm = {}) {
    ConstrainedSurfaceOptions options;
    options.cube_mm = cube_mm;
    const auto mesh = constrained_surface(points, options);
    return mesh ? ErrorCode::kInternal : mesh.error().code;
  };
  EXPECT_EQ(code({}), ErrorCode::kInsufficientData);
  EXPECT_EQ(code(Points(50, Vector3d(1, 2, 3))), ErrorCode::kInsufficientData);
  EXPECT_EQ(code({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), ErrorCode::kInsufficientData);
  EXPECT_EQ(code(ring(300), 1e-4), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(ring(300), 0.0), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(ring(300), std::numeric_limits<double>::quiet_NaN()), ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace instep
