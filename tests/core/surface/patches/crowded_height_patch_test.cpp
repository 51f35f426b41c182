// Patches of points that lie so close that one kernel says the same as another.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/surface/patches/height_patch.h"
#include "tests/support/kriging_by_lu.h"
#include "tests/support/oriented_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

/// On waves, with the slopes that they have there.
OrientedPoints waves(std::size_t count, bool normals_told) {
  auto points = test::disc_points(Vector3d::Zero(), Vector3d::UnitZ(), 1.0, count, 0.0, 3);
  for (auto& point : points) {
    auto& place = point.position;
    place.z() = 0.1 * std::sin(2.0 * place.x()) * std::cos(1.5 * place.y());
    point.normal = Vector3d(-0.2 * std::cos(2.0 * place.x()) * std::cos(1.5 * place.y()),
                            0.15 * std::sin(2.0 * place.x()) * std::sin(1.5 * place.y()), 1.0)
                       .normalized();
    point.normal_told = normals_told;
  }
  return points;
}

HeightPatch patch_of(const OrientedPoints& points, bool crowded) {
  return HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.05, crowded).value();
}

/// How far the patch is off the surface of the kernel r^3 through the points.
double off_cubic(const HeightPatch& patch, const OrientedPoints& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix2Xd places(2, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + 6);
  for (Eigen::Index i = 0; i < count; ++i) {
    places.col(i) = points[static_cast<std::size_t>(i)].position.head<2>();
    right[i] = points[static_cast<std::size_t>(i)].position.z();
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count + 6, count + 6);
  const test::KrigingByLu model;
  system.topLeftCorner(count, count) = model.kernel_of(places).topLeftCorner(count, count);
  system.topRightCorner(count, 6) = model.polynomial_block(places).topRows(count);
  system.bottomLeftCorner(6, count) = system.topRightCorner(count, 6).transpose();
  const Eigen::VectorXd solution = system.fullPivLu().solve(right);
  double most = 0.0;
  for (const double x : {-0.5, -0.1, 0.3, 0.6}) {
    for (const double y : {-0.6, -0.2, 0.1, 0.4}) {
      Eigen::VectorXd row(count + 6);
      const Eigen::VectorXd beside = model.beside(places, {x, y});
      row << beside.head(count), beside.tail(6);
      most = std::max(most, std::abs(patch.at({x, y, row.dot(solution)}).value));
    }
  }
  return most;
}

TEST(CrowdedHeightPatch, IsThatOfOneKernel) {
  const auto points = test::without_bend_round(waves(40, false));
  EXPECT_LT(off_cubic(patch_of(points, true), points), 1e-7);
  EXPECT_GT(off_cubic(patch_of(points, false), points), 1e-5) << "smoother ones are likelier";
  EXPECT_FALSE(patch_of(points, true).is_smooth());
}

TEST(CrowdedHeightPatch, IsOnTheSurface) {
  const auto patch = patch_of(waves(60, false), true);
  for (const double x : {-0.5, 0.0, 0.4}) {
    const double height = 0.1 * std::sin(2.0 * x) * std::cos(1.5 * 0.2);
    EXPECT_NEAR(patch.at({x, 0.2, height}).value, 0.0, 2e-3);
  }
}

/// Their slopes tell kernels apart.
TEST(CrowdedHeightPatch, OfToldNormalsIsAsOfOthers) {
  const auto points = waves(40, true);
  const auto crowded = patch_of(points, true);
  const auto other = patch_of(points, false);
  EXPECT_GT(off_cubic(other, points), 1e-5);
  for (const double x : {-0.5, -0.1, 0.3, 0.6}) {
    EXPECT_EQ(crowded.at({x, 0.2, 0.0}).value, other.at({x, 0.2, 0.0}).value);
  }
}

}  // namespace
}  // namespace instep
