#include "core/geometry/principal_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

/// A box of random points with half-sides 3, 2 and 1, turned and moved.
std::vector<Vector3d> turned_box(const Eigen::Matrix3d& turn, const Vector3d& shift) {
  test::RandomNumbers random(4);
  std::vector<Vector3d> points;
  for (int i = 0; i < 20000; ++i) {
    points.emplace_back(
        turn * Vector3d(random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(-1, 1)) +
        shift);
  }
  return points;
}

TEST(PrincipalFrame, FindsTheAxesAndTheMiddleOfATurnedBox) {
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.7, Vector3d(1, -2, 3).normalized()));
  const Vector3d shift(5000, -300, 20);
  const auto points = turned_box(turn, shift);
  const RigidTransform principal = principal_from_input(points);
  EXPECT_TRUE(is_rigid(principal.matrix(), 1e-9));
  EXPECT_LT((principal * shift).norm(), 0.05);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    EXPECT_GT(std::abs(principal.linear().row(axis).dot(turn.col(axis))), 0.999) << axis;
  }
}

TEST(PrincipalFrame, SpreadOfABoxIsAThirdOfItsSquaredHalfSides) {
  const auto spread = spread_of(turned_box(Eigen::Matrix3d::Identity(), {0, 0, 0}));
  EXPECT_NEAR(spread.covariance(0, 0), 3.0, 0.08);
  EXPECT_NEAR(spread.covariance(1, 1), 4.0 / 3.0, 0.04);
  EXPECT_NEAR(spread.covariance(2, 2), 1.0 / 3.0, 0.01);
}

TEST(PrincipalFrame, DividesByOneLessThanTheCount) {
  const auto spread = spread_of({{0, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(spread.mean, Vector3d(1, 0, 0));
  EXPECT_EQ(spread.covariance(0, 0), 2.0);
}

TEST(PrincipalFrame, IsRigidForPointsThatSpanNoSpace) {
  EXPECT_TRUE(is_rigid(principal_from_input({{1, 2, 3}}).matrix(), 1e-9));
  EXPECT_TRUE(is_rigid(principal_from_input({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}).matrix(), 1e-9));
}

}  // namespace
}  // namespace instep
