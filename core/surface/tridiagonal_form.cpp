#include "core/surface/tridiagonal_form.h"

#include <cmath>

#include "core/surface/row_groups.h"

namespace instep {
namespace {

/// The matrix in whole groups of rows: a column begins with the group of its diagonal, which holds
/// both triangles there, and ends in zeros.
Eigen::MatrixXd in_groups(const Eigen::MatrixXd& lower) {
  const Eigen::Index count = lower.cols();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(whole_groups(count), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    matrix.col(j).segment(j, count - j) = lower.col(j).tail(count - j);
    for (Eigen::Index i = group_of(j); i < j; ++i) matrix(i, j) = lower(j, i);
  }
  return matrix;
}

/// Adds the part of the matrix from row and column `first` on times a vector that is zero before.
void add_product(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& vector, Eigen::Index first,
                 Eigen::VectorXd& product) {
  for (Eigen::Index j = first; j < matrix.cols(); ++j) {
    const double* column = matrix.col(j).data();
    const Eigen::Index own = group_of(j);
    rows_at(product, own) += vector[j] * rows_at(column, own);
    RowGroup dot = RowGroup::Zero();
    for (Eigen::Index i = own + kRowGroup; i < matrix.rows(); i += kRowGroup) {
      const RowGroup rows = rows_at(column, i);
      rows_at(product, i) += vector[j] * rows;
      dot += rows_at(vector, i) * rows;
    }
    product[j] += dot.sum();
  }
}

/// Takes a * b' + b * a' from that part.
void subtract_both_ways(const Eigen::VectorXd& a, const Eigen::VectorXd& b, Eigen::Index first,
                        Eigen::MatrixXd& matrix) {
  for (Eigen::Index j = first; j < matrix.cols(); ++j) {
    double* column = matrix.col(j).data();
    for (Eigen::Index i = group_of(j); i < matrix.rows(); i += kRowGroup) {
      rows_at(column, i) -= b[j] * rows_at(a, i) + a[j] * rows_at(b, i);
    }
  }
}

}  // namespace

TridiagonalForm tridiagonal_form(const Eigen::MatrixXd& lower, const Eigen::VectorXd& vector) {
  const Eigen::Index count = lower.cols();
  Eigen::MatrixXd matrix = in_groups(lower);
  TridiagonalForm form{Eigen::VectorXd(count), Eigen::VectorXd(count - 1), vector};
  Eigen::VectorXd mirror = Eigen::VectorXd::Zero(matrix.rows());  // normal of the reflection
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(matrix.rows());
  for (Eigen::Index k = 0; k + 1 < count; ++k) {
    const Eigen::Index rest = count - k - 1;
    form.diagonal[k] = matrix(k, k);
    mirror[k] = 0.0;
    mirror.segment(k + 1, rest) = matrix.col(k).segment(k + 1, rest);
    const double length = mirror.segment(k + 1, rest).norm();
    const double head = mirror[k + 1];
    form.beside[k] = head > 0.0 ? -length : length;
    if (!(length > 0.0)) continue;
    mirror[k + 1] -= form.beside[k];
    const double twice = 1.0 / (length * (length + std::abs(head)));  // over the normal's square
    moved.setZero();
    add_product(matrix, mirror, k + 1, moved);
    moved.head(k + 1).setZero();
    moved *= twice;
    moved -= 0.5 * twice * moved.dot(mirror) * mirror;
    subtract_both_ways(mirror, moved, k + 1, matrix);
    auto seen = form.vector.tail(rest);
    seen -= twice * mirror.segment(k + 1, rest).dot(seen) * mirror.segment(k + 1, rest);
  }
  form.diagonal[count - 1] = matrix(count - 1, count - 1);
  return form;
}

}  // namespace instep
