#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "core/surface/patches/height_patch.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"
#include "tests/support/wavy_points.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::uneven_points;
using test::wavy_points;
using OrientedPoints = std::vector<OrientedPoint>;

/// The first monomials of a cubic polynomial.
Eigen::RowVectorXd terms_at(const Vector3d& p, Eigen::Index terms = 6) {
  const double x = p.x();
  const double y = p.y();
  Eigen::RowVectorXd row(10);
  row << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return row.head(terms);
}

double kernel(const Vector3d& a, const Vector3d& b, int power) {
  return std::pow((a - b).head<2>().norm(), power);
}

double cubed_distance(const Vector3d& a, const Vector3d& b) {
  return kernel(a, b, 3);
}

/// Eq. 7 in the plane, without smoothing and with six monomials, or ten for r^7, solved by LU
/// decomposition.
double height_by_lu(const OrientedPoints& points, const Vector3d& place, int power) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index terms = power == 7 ? 10 : 6;
  const auto at = [&](Eigen::Index i) { return points[static_cast<std::size_t>(i)].position; };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + terms, count + terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + terms);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) matrix(i, j) = kernel(at(i), at(j), power);
    matrix.row(i).tail(terms) = terms_at(at(i), terms);
    matrix.col(i).tail(terms) = terms_at(at(i), terms).transpose();
    right[i] = at(i).z();
  }
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(right);
  double height = terms_at(place, terms).dot(solution.tail(terms));
  for (Eigen::Index i = 0; i < count; ++i) height += solution[i] * kernel(place, at(i), power);
  return height;
}

/// Twice the negative log of the restricted likelihood of the points' heights, up to a constant:
/// what is left of them once any quadratic is taken out has covariance roughness * r^3 + variance.
double misfit_by_hand(const OrientedPoints& points, double roughness) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd covariance(count, count);
  Eigen::MatrixXd quadratics(count, 6);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& point = points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < count; ++j) {
      covariance(i, j) =
          roughness * cubed_distance(point.position, points[static_cast<std::size_t>(j)].position);
    }
    covariance(i, i) += point.variance;
    quadratics.row(i) = terms_at(point.position);
    heights[i] = point.position.z();
  }
  const Eigen::MatrixXd orthogonal =
      Eigen::HouseholderQR<Eigen::MatrixXd>(quadratics).householderQ();
  const Eigen::MatrixXd rest = orthogonal.rightCols(count - 6);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rest.transpose() * covariance * rest);
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * rest.transpose() * heights;
  return (along.array().square() / solver.eigenvalues().array() +
          solver.eigenvalues().array().log())
      .sum();
}

/// Whether a patch is the surface of that kernel through the points, over a plane for their lack of
/// bend, up to the least smoothing; the other kernels' are some 1e-3 off.
void expect_solves(const OrientedPoints& bent, int power) {
  const auto points = test::without_bend_round(bent);
  const auto patch = HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.05);
  ASSERT_TRUE(patch);
  test::RandomNumbers random(6);
  for (int i = 0; i < 20; ++i) {
    Vector3d place(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 0.0);
    place.z() = height_by_lu(points, place, power);
    EXPECT_NEAR(patch->at(place).value, 0.0, 1e-6) << points.size();
  }
}

TEST(HeightPatch, OfUnevenPointsIsTheCubicSurfaceThatLuDecompositionFinds) {
  for (const std::size_t count : {12U, 20U, 60U}) expect_solves(uneven_points(count), 3);
}

TEST(HeightPatch, OfASmoothWaveIsTheQuinticSurfaceThatLuDecompositionFinds) {
  for (const std::size_t count : {50U, 60U}) expect_solves(wavy_points(count, 0.1, 0.0, 5), 5);
}

TEST(HeightPatch, OfASmootherWaveIsTheSepticSurfaceThatLuDecompositionFinds) {
  for (const std::size_t count : {50U, 60U}) expect_solves(wavy_points(count, 0.1, 0.0, 5, 0.4), 7);
}

/// A ridge: the kernels that fit smooth surfaces would overshoot beside it.
TEST(HeightPatch, OfARidgeIsTheCubicSurface) {
  auto points = wavy_points(60, 0.0, 0.0, 5);
  for (auto& point : points) point.position.z() -= 0.5 * std::abs(point.position.x() - 0.1);
  expect_solves(points, 3);
}

TEST(HeightPatch, RoughnessIsTheLikeliestToWithinAFactorOfThree) {
  const auto points = wavy_points(50, 0.1, 0.02, 5);
  double likeliest = 1e-4;
  for (double roughness = 1e-4; roughness < 100.0; roughness *= 1.2) {
    if (misfit_by_hand(points, roughness) < misfit_by_hand(points, likeliest)) {
      likeliest = roughness;
    }
  }
  for (const double prior : {0.01, 0.05, 0.1, 0.5}) {
    const auto patch = HeightPatch::fit(points, Vector3d::Zero(), Vector3d::UnitZ(), 1.0, prior);
    ASSERT_TRUE(patch);
    EXPECT_LT(std::abs(std::log(patch->roughness() / likeliest)), std::log(3.0)) << prior;
  }
}

}  // namespace
}  // namespace instep
