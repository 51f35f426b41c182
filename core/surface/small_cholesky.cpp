#include "core/surface/small_cholesky.h"

#include <cmath>
#include <utility>

namespace instep {

std::optional<SmallCholesky> SmallCholesky::of(Eigen::MatrixXd matrix) {
  const Eigen::Index count = matrix.cols();
  for (Eigen::Index j = 0; j < count; ++j) {
    const double pivot = matrix(j, j);
    if (!(pivot > 0.0)) return std::nullopt;
    const double root = std::sqrt(pivot);
    matrix.col(j).tail(count - j) /= root;
    for (Eigen::Index k = j + 1; k < count; ++k) {
      matrix.col(k).tail(count - k) -= matrix(k, j) * matrix.col(j).tail(count - k);
    }
  }
  SmallCholesky cholesky;
  cholesky.lower_ = std::move(matrix);
  return cholesky;
}

Eigen::VectorXd SmallCholesky::solve(Eigen::VectorXd right) const {
  const Eigen::Index count = size();
  for (Eigen::Index j = 0; j < count; ++j) {
    right[j] /= lower_(j, j);
    right.tail(count - j - 1) -= right[j] * lower_.col(j).tail(count - j - 1);
  }
  for (Eigen::Index j = count - 1; j >= 0; --j) {
    right[j] -= lower_.col(j).tail(count - j - 1).dot(right.tail(count - j - 1));
    right[j] /= lower_(j, j);
  }
  return right;
}

Eigen::VectorXd SmallCholesky::rooted(const Eigen::VectorXd& vector) const {
  const Eigen::Index count = size();
  Eigen::VectorXd product(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    product[j] = lower_.col(j).tail(count - j).dot(vector.tail(count - j));
  }
  return product;
}

double SmallCholesky::log_volume() const {
  return 2.0 * lower_.diagonal().array().log().sum();
}

Eigen::VectorXd SmallCholesky::inverse_diagonal() const {
  const Eigen::Index count = size();
  Eigen::VectorXd diagonal(count);
  Eigen::VectorXd column(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    // A column of the root's inverse, which is a triangle too.
    auto own = column.tail(count - i);
    own.setZero();
    own[0] = 1.0;
    for (Eigen::Index j = i; j < count; ++j) {
      column[j] /= lower_(j, j);
      column.tail(count - j - 1) -= column[j] * lower_.col(j).tail(count - j - 1);
    }
    diagonal[i] = own.squaredNorm();
  }
  return diagonal;
}

}  // namespace instep
