#include "core/surface/tridiagonal_form.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd some_symmetric(Index count) {
  test::RandomNumbers random(static_cast<std::uint64_t>(count));
  const MatrixXd half = MatrixXd::NullaryExpr(count, count, [&] { return random.normal(); });
  return half + half.transpose();
}

MatrixXd dense(const TridiagonalForm& form) {
  MatrixXd matrix = form.diagonal.asDiagonal();
  for (Index i = 0; i < form.beside.size(); ++i) {
    matrix(i + 1, i) = matrix(i, i + 1) = form.beside[i];
  }
  return matrix;
}

VectorXd eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

/// What is the same from all axes: eigenvalues, and the vector with any power of the matrix
/// between.
TEST(TridiagonalForm, IsTheSameMatrixAndVectorSeenFromOtherAxes) {
  for (const Index count : {1, 2, 3, 4, 5, 8, 45, 60, 61}) {
    const MatrixXd matrix = some_symmetric(count);
    const VectorXd vector = matrix.col(0) + VectorXd::LinSpaced(count, -1.0, 1.0);
    const auto form = tridiagonal_form(matrix, vector);
    ASSERT_EQ(form.beside.size(), count - 1);
    const double size = matrix.norm();
    EXPECT_LT((eigenvalues(dense(form)) - eigenvalues(matrix)).norm(), 1e-13 * size) << count;
    VectorXd here = vector;
    VectorXd there = form.vector;
    for (int power = 0; power < 4; ++power) {
      EXPECT_NEAR(there.dot(form.vector) / here.norm(), here.dot(vector) / here.norm(),
                  1e-12 * vector.norm())
          << count << ", power " << power;
      here = matrix * here;
      there = dense(form) * there;
    }
  }
}

TEST(TridiagonalForm, ReadsTheLowerTriangleOnly) {
  MatrixXd matrix = some_symmetric(11);
  const VectorXd vector = VectorXd::Ones(11);
  const auto expected = tridiagonal_form(matrix, vector);
  matrix.triangularView<Eigen::StrictlyUpper>().setConstant(std::nan(""));
  const auto form = tridiagonal_form(matrix, vector);
  EXPECT_EQ(form.diagonal, expected.diagonal);
  EXPECT_EQ(form.beside, expected.beside);
  EXPECT_EQ(form.vector, expected.vector);
}

TEST(TridiagonalForm, LeavesWhatIsDiagonalAsItIs) {
  const VectorXd diagonal = VectorXd::LinSpaced(9, 1.0, 9.0);
  const auto form = tridiagonal_form(diagonal.asDiagonal(), diagonal);
  EXPECT_EQ(form.diagonal, diagonal);
  EXPECT_EQ(form.beside, VectorXd::Zero(8));
  EXPECT_EQ(form.vector, diagonal);
}

}  // namespace
}  // namespace instep
