#include "core/surface/small_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Positive definite, of any size.
MatrixXd some_matrix(Index count) {
  test::RandomNumbers random(static_cast<std::uint64_t>(count));
  const MatrixXd root = MatrixXd::NullaryExpr(count, count, [&] { return random.normal(); });
  return root * root.transpose() + 0.1 * MatrixXd::Identity(count, count);
}

VectorXd some_vector(Index count) {
  test::RandomNumbers random(99);
  return VectorXd::NullaryExpr(count, [&] { return random.normal(); });
}

TEST(SmallCholesky, DoesAsDenseAlgebraDoes) {
  for (const Index count : {1, 2, 3, 8, 45, 64}) {
    const MatrixXd matrix = some_matrix(count);
    const VectorXd vector = some_vector(count);
    const Eigen::FullPivLU<MatrixXd> dense(matrix);
    const auto cholesky = SmallCholesky::of(matrix);
    ASSERT_TRUE(cholesky) << count;
    const double size = dense.inverse().norm();
    EXPECT_LT((cholesky->solve(vector) - dense.solve(vector)).norm(), 1e-12 * size * vector.norm());
    EXPECT_NEAR(cholesky->log_volume(), std::log(dense.determinant()), 1e-10);
    EXPECT_NEAR(cholesky->rooted(vector).squaredNorm(), vector.dot(matrix * vector),
                1e-12 * matrix.norm() * vector.squaredNorm());
    EXPECT_LT((cholesky->inverse_diagonal() - dense.inverse().diagonal()).norm(), 1e-12 * size);
  }
}

TEST(SmallCholesky, ReadsTheLowerTriangleOnly) {
  MatrixXd matrix = some_matrix(12);
  const VectorXd expected = SmallCholesky::of(matrix)->solve(some_vector(12));
  matrix.triangularView<Eigen::StrictlyUpper>().setConstant(std::nan(""));
  EXPECT_EQ(SmallCholesky::of(matrix)->solve(some_vector(12)), expected);
}

TEST(SmallCholesky, RefusesWhatIsNotPositiveDefinite) {
  MatrixXd matrix = some_matrix(20);
  matrix(13, 13) = -1.0;
  EXPECT_FALSE(SmallCholesky::of(matrix));
  matrix(13, 13) = std::nan("");
  EXPECT_FALSE(SmallCholesky::of(matrix));
  EXPECT_FALSE(SmallCholesky::of(MatrixXd::Zero(3, 3)));
}

}  // namespace
}  // namespace instep
