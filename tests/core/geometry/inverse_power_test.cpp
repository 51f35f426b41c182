#include "core/geometry/inverse_power.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/geometry/principal_frame.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

TEST(InversePower, AgreesWithAFullEigenvalueSolver) {
  test::RandomNumbers random(9);
  for (int run = 0; run < 200; ++run) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 12; ++i) {
      points.emplace_back(random.normal(), 5.0 * random.normal(), 0.2 * random.normal());
    }
    const Eigen::Matrix3d covariance = spread_of(points).covariance;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    EXPECT_NEAR(std::abs(smallest_axis(covariance).dot(solver.eigenvectors().col(0))), 1.0, 1e-12);
  }
}

TEST(InversePower, FindsTheNormalOfAnExactPlane) {
  for (const Vector3d& normal :
       {Vector3d(0, 0, 1), Vector3d(1, 0, 0), Vector3d(1, -2, 0.5).normalized().eval()}) {
    const Vector3d u = normal.unitOrthogonal();
    const Vector3d v = normal.cross(u);
    std::vector<Vector3d> points;
    for (int i = 0; i < 25; ++i) points.emplace_back((i % 5) * u + (i / 5) * 0.5 * v);
    const Vector3d axis = smallest_axis(spread_of(points).covariance);
    ASSERT_TRUE(axis.allFinite());
    EXPECT_NEAR(std::abs(axis.dot(normal)), 1.0, 1e-12);
  }
}

TEST(InversePower, GivesAUnitVectorWhereThereIsNoSmallestAxis) {
  const Eigen::Matrix3d zero = Eigen::Matrix3d::Zero();
  EXPECT_EQ(smallest_axis(zero), Vector3d::UnitZ());
  EXPECT_EQ(smallest_axis(zero.array() + std::numeric_limits<double>::quiet_NaN()),
            Vector3d::UnitZ());
  const Vector3d line(1, 2, 3);
  const Vector3d across = smallest_axis(line * line.transpose());
  EXPECT_NEAR(across.norm(), 1.0, 1e-12);
  EXPECT_NEAR(across.dot(line.normalized()), 0.0, 1e-6);
  EXPECT_NEAR(smallest_axis(Eigen::Matrix3d::Identity()).norm(), 1.0, 1e-12);
}

TEST(InversePower, DoesNotDependOnTheUnit) {
  Eigen::Matrix3d covariance = Eigen::Vector3d(3, 2, 1).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = 0.4;
  covariance(1, 2) = covariance(2, 1) = -0.3;
  const Vector3d axis = smallest_axis(covariance);
  EXPECT_LT((smallest_axis(1e-12 * covariance) - axis).norm(), 1e-12);
  EXPECT_LT((smallest_axis(1e12 * covariance) - axis).norm(), 1e-12);
}

}  // namespace
}  // namespace instep
