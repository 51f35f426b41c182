#include "core/surface/small_cholesky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/surface/row_groups.h"

namespace instep {
namespace {

/// Takes a column times `factor` from another, from the group of row `from` on.
void subtract(double factor, const double* column, Eigen::Index from, Eigen::Index rows,
              double* other) {
  for (Eigen::Index i = group_of(from); i < rows; i += kRowGroup) {
    rows_at(other, i) -= factor * rows_at(column, i);
  }
}

/// The same with a group of columns and their factors at once.
void subtract_group(const RowGroup& factors, const double* columns, Eigen::Index from,
                    Eigen::Index rows, double* other) {
  for (Eigen::Index i = group_of(from); i < rows; i += kRowGroup) {
    RowGroup rest = rows_at(other, i);
    for (Eigen::Index k = 0; k < kRowGroup; ++k) {
      rest -= factors[k] * rows_at(columns + k * rows, i);
    }
    rows_at(other, i) = rest;
  }
}

double dot(const double* a, const double* b, Eigen::Index from, Eigen::Index rows) {
  RowGroup sum = RowGroup::Zero();
  for (Eigen::Index i = group_of(from); i < rows; i += kRowGroup) {
    sum += rows_at(a, i) * rows_at(b, i);
  }
  return sum.sum();
}

/// `padded` with zeros to whole groups.
Eigen::VectorXd padded(const Eigen::VectorXd& vector, Eigen::Index rows) {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(rows);
  whole.head(vector.size()) = vector;
  return whole;
}

}  // namespace

std::optional<SmallCholesky> SmallCholesky::of(const Eigen::MatrixXd& matrix) {
  const Eigen::Index count = matrix.cols();
  const Eigen::Index rows = whole_groups(count);
  SmallCholesky cholesky;
  cholesky.lower_ = Eigen::MatrixXd::Zero(rows, count);
  Eigen::MatrixXd& lower = cholesky.lower_;
  for (Eigen::Index j = 0; j < count; ++j) {
    lower.col(j).segment(j, count - j) = matrix.col(j).tail(count - j);
  }
  for (Eigen::Index first = 0; first < count; first += kRowGroup) {
    const Eigen::Index last = std::min(first + kRowGroup, count);
    for (Eigen::Index j = first; j < last; ++j) {
      double* own = lower.col(j).data();
      if (!(own[j] > 0.0)) return std::nullopt;
      const double root = std::sqrt(own[j]);
      for (Eigen::Index i = group_of(j); i < rows; i += kRowGroup) rows_at(own, i) /= root;
      for (Eigen::Index k = j + 1; k < last; ++k) {
        subtract(own[k], own, k, rows, lower.col(k).data());
      }
    }
    for (Eigen::Index k = last; k < count; ++k) {
      const RowGroup factors = lower.row(k).segment<kRowGroup>(first).transpose();
      subtract_group(factors, lower.col(first).data(), k, rows, lower.col(k).data());
    }
  }
  for (Eigen::Index j = 0; j < count; ++j) lower.col(j).head(j).setZero();
  return cholesky;
}

/// The root's inverse times `right`.
void SmallCholesky::solve_root(double* right) const {
  for (Eigen::Index j = 0; j < size(); ++j) {
    const double value = right[j] / lower_(j, j);
    subtract(value, lower_.col(j).data(), j, lower_.rows(), right);
    right[j] = value;
  }
}

Eigen::VectorXd SmallCholesky::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd solved = padded(right, lower_.rows());
  solve_root(solved.data());
  for (Eigen::Index j = size() - 1; j >= 0; --j) {
    const double value = solved[j];
    solved[j] = 0.0;
    const double others = dot(lower_.col(j).data(), solved.data(), j, lower_.rows());
    solved[j] = (value - others) / lower_(j, j);
  }
  solved.conservativeResize(size());
  return solved;
}

Eigen::VectorXd SmallCholesky::rooted(const Eigen::VectorXd& vector) const {
  const Eigen::VectorXd whole = padded(vector, lower_.rows());
  Eigen::VectorXd product(size());
  for (Eigen::Index j = 0; j < size(); ++j) {
    product[j] = dot(lower_.col(j).data(), whole.data(), j, lower_.rows());
  }
  return product;
}

double SmallCholesky::log_volume() const {
  return 2.0 * lower_.diagonal().array().log().sum();
}

Eigen::VectorXd SmallCholesky::inverse_diagonal() const {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(lower_.rows());
  std::vector<RowGroup> inverse(static_cast<std::size_t>(size()));  // a group of columns, by rows
  for (Eigen::Index first = 0; first < size(); first += kRowGroup) {
    RowGroup sum = RowGroup::Zero();
    for (Eigen::Index j = first; j < size(); ++j) {
      RowGroup row = RowGroup::Zero();
      if (j < first + kRowGroup) row[j - first] = 1.0;
      for (Eigen::Index k = first; k < j; ++k) {
        row -= lower_(j, k) * inverse[static_cast<std::size_t>(k)];
      }
      row /= lower_(j, j);
      inverse[static_cast<std::size_t>(j)] = row;
      sum += row.square();
    }
    squares.segment<kRowGroup>(first) = sum;
  }
  return squares.head(size());
}

}  // namespace instep
