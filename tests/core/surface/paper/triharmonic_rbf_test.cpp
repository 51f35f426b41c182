#include "core/surface/paper/triharmonic_rbf.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// The matrix of eq. 7, entry by entry.
Eigen::MatrixXd matrix_of_equation_7(const Points& points, const std::vector<double>& lambdas) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + 4, count + 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3d& p = points[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < count; ++j) {
      matrix(i, j) = std::pow((p - points[static_cast<std::size_t>(j)]).norm(), 3);
    }
    matrix(i, i) += lambdas[static_cast<std::size_t>(i)];
    matrix.row(i).tail(4) << 1.0, p.transpose();
    matrix.col(i).tail(4) << 1.0, p;
  }
  return matrix;
}

Points random_points(std::size_t count, std::uint64_t seed, double size = 1.0) {
  test::RandomNumbers random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(size * random.uniform(), size * random.uniform(), size * random.uniform());
  }
  return points;
}

std::vector<double> random_values(std::size_t count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(random.normal());
  return values;
}

/// Eq. 6 with the solution of eq. 7 by LU decomposition.
double value_by_lu(const Points& points, const std::vector<double>& values,
                   const std::vector<double>& lambdas, const Vector3d& place) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + 4);
  for (Eigen::Index i = 0; i < count; ++i) right[i] = values[static_cast<std::size_t>(i)];
  const Eigen::VectorXd solution = matrix_of_equation_7(points, lambdas).fullPivLu().solve(right);
  double value = solution[count] + solution.tail(3).dot(place);
  for (Eigen::Index i = 0; i < count; ++i) {
    value += solution[i] * std::pow((place - points[static_cast<std::size_t>(i)]).norm(), 3);
  }
  return value;
}

void expect_same_as_lu(const std::vector<double>& lambdas) {
  const std::size_t count = lambdas.size();
  const auto points = random_points(count, 1);
  const auto values = random_values(count, 2);
  const auto rbf = TriharmonicRbf::fit(points, values, lambdas);
  ASSERT_TRUE(rbf);
  for (const auto& place : random_points(30, 3, 1.5)) {
    EXPECT_NEAR(rbf->at(place), value_by_lu(points, values, lambdas, place), 1e-7);
  }
}

TEST(TriharmonicRbf, SolvesEquation7AsLuDecompositionDoes) {
  for (const std::size_t count : {4U, 5U, 10U, 60U}) {
    expect_same_as_lu(std::vector<double>(count, 0.0));
  }
}

TEST(TriharmonicRbf, TakesALambdaOfItsOwnForEachPoint) {
  std::vector<double> lambdas;
  for (int i = 0; i < 40; ++i) lambdas.push_back(i % 2 == 0 ? 0.0 : 0.03 * i);
  expect_same_as_lu(lambdas);
  const auto points = random_points(40, 1);
  const auto values = random_values(40, 2);
  const auto rbf = TriharmonicRbf::fit(points, values, lambdas);
  ASSERT_TRUE(rbf);
  EXPECT_NEAR(rbf->at(points[0]), values[0], 1e-9) << "a point without lambda is met";
  EXPECT_GT(std::abs(rbf->at(points[39]) - values[39]), 1e-3) << "one with lambda is not";
}

TEST(TriharmonicRbf, PassesThroughThreeHundredPointsFarFromTheOriginInAnyUnit) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    auto points = random_points(300, 5, 20.0 * unit);
    for (auto& point : points) point += unit * Vector3d(5000, -3000, 100);
    const auto values = random_values(300, 6);
    const auto rbf = TriharmonicRbf::fit(points, values, std::vector<double>(300, 0.0));
    ASSERT_TRUE(rbf);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(rbf->at(points[i]), values[i], 1e-8);
    }
  }
}

TEST(TriharmonicRbf, ReproducesALinearFieldEverywhere) {
  const auto points = random_points(50, 8, 10.0);
  const auto field = [](const Vector3d& p) { return 2.0 + p.dot(Vector3d(0.5, -1.0, 3.0)); };
  std::vector<double> values;
  for (const auto& point : points) values.push_back(field(point));
  const auto rbf = TriharmonicRbf::fit(points, values, std::vector<double>(50, 0.7));
  ASSERT_TRUE(rbf);
  for (const auto& place : random_points(20, 9, 40.0)) {
    EXPECT_NEAR(rbf->at(place), field(place), 1e-8);
  }
}

TEST(TriharmonicRbf, MatrixOfEquation7IsNotPositiveDefiniteAsThePaperSays) {
  const auto points = random_points(60, 4);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      matrix_of_equation_7(points, std::vector<double>(60, 0.0)));
  EXPECT_EQ((solver.eigenvalues().array() < 0.0).count(), 4);
  EXPECT_EQ((solver.eigenvalues().array() > 0.0).count(), 60);
}

TEST(TriharmonicRbf, RanksAreThoseOfTable1) {
  for (const auto& [count, rank] : {std::pair{1, 2}, {2, 4}, {3, 6}, {4, 8}, {5, 9}, {12, 16}}) {
    const auto points = random_points(static_cast<std::size_t>(count), 11);
    const std::vector<double> lambdas(points.size(), 0.0);
    EXPECT_EQ(rank_of_system(points), rank) << count << " points";
    EXPECT_EQ(matrix_of_equation_7(points, lambdas).fullPivLu().rank(), rank) << count;
    EXPECT_EQ(has_unique_solution(points), count >= 4) << count;
    EXPECT_EQ(TriharmonicRbf::fit(points, lambdas, lambdas).has_value(), count >= 4) << count;
  }
}

TEST(TriharmonicRbf, PointsInOnePlaneOrLineNeverReachFullRank) {
  auto flat = random_points(40, 12, 50.0);
  for (auto& point : flat) point.z() = 0.25 * point.x() - point.y() + 7.0;
  Points straight;
  for (int i = 0; i < 12; ++i) straight.push_back(Vector3d(1, 1, 1) + i * Vector3d(1, 2, -1));
  for (const auto& points : {flat, straight}) {
    const std::vector<double> zeros(points.size(), 0.0);
    Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix_of_equation_7(points, zeros));
    lu.setThreshold(1e-12);
    EXPECT_EQ(rank_of_system(points), lu.rank());
    EXPECT_FALSE(has_unique_solution(points));
    EXPECT_FALSE(TriharmonicRbf::fit(points, zeros, zeros));
  }
}

TEST(TriharmonicRbf, RefusesNoPoints) {
  EXPECT_FALSE(TriharmonicRbf::fit({}, {}, {}));
  EXPECT_FALSE(has_unique_solution({}));
}

}  // namespace
}  // namespace instep
