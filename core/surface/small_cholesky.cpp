#include "core/surface/small_cholesky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace instep {
namespace {

/// Rows are worked on in groups of so many, from the beginning of one: at the head of a column they
/// reach over the diagonal, where the root is zero, and at its end beyond the matrix, where it is
/// too. Whole groups cost less than their exact ends.
constexpr Eigen::Index kGroup = 4;
using Group = Eigen::Array<double, kGroup, 1>;

Eigen::Index group_of(Eigen::Index row) {
  return row - row % kGroup;
}

/// Takes a column times `factor` from another, from the group of row `from` on.
void subtract(double factor, const double* column, Eigen::Index from, Eigen::Index rows,
              double* other) {
  for (Eigen::Index i = group_of(from); i < rows; i += kGroup) {
    Group::MapAligned(other + i) -= factor * Group::MapAligned(column + i);
  }
}

/// The same with a group of columns and their factors at once.
void subtract_group(const Group& factors, const double* columns, Eigen::Index from,
                    Eigen::Index rows, double* other) {
  for (Eigen::Index i = group_of(from); i < rows; i += kGroup) {
    Group rest = Group::MapAligned(other + i);
    for (Eigen::Index k = 0; k < kGroup; ++k) {
      rest -= factors[k] * Group::MapAligned(columns + k * rows + i);
    }
    Group::MapAligned(other + i) = rest;
  }
}

double dot(const double* a, const double* b, Eigen::Index from, Eigen::Index rows) {
  Group sum = Group::Zero();
  for (Eigen::Index i = group_of(from); i < rows; i += kGroup) {
    sum += Group::MapAligned(a + i) * Group::MapAligned(b + i);
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
  const Eigen::Index rows = group_of(count + kGroup - 1);
  SmallCholesky cholesky;
  cholesky.lower_ = Eigen::MatrixXd::Zero(rows, count);
  Eigen::MatrixXd& lower = cholesky.lower_;
  for (Eigen::Index j = 0; j < count; ++j) {
    lower.col(j).segment(j, count - j) = matrix.col(j).tail(count - j);
  }
  for (Eigen::Index first = 0; first < count; first += kGroup) {
    const Eigen::Index last = std::min(first + kGroup, count);
    for (Eigen::Index j = first; j < last; ++j) {
      double* own = lower.col(j).data();
      if (!(own[j] > 0.0)) return std::nullopt;
      const double root = std::sqrt(own[j]);
      for (Eigen::Index i = group_of(j); i < rows; i += kGroup) Group::MapAligned(own + i) /= root;
      for (Eigen::Index k = j + 1; k < last; ++k) {
        subtract(own[k], own, k, rows, lower.col(k).data());
      }
    }
    for (Eigen::Index k = last; k < count; ++k) {
      const Group factors = lower.row(k).segment<kGroup>(first).transpose();
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
  std::vector<Group> inverse(static_cast<std::size_t>(size()));  // a group of columns, by rows
  for (Eigen::Index first = 0; first < size(); first += kGroup) {
    Group sum = Group::Zero();
    for (Eigen::Index j = first; j < size(); ++j) {
      Group row = Group::Zero();
      if (j < first + kGroup) row[j - first] = 1.0;
      for (Eigen::Index k = first; k < j; ++k) {
        row -= lower_(j, k) * inverse[static_cast<std::size_t>(k)];
      }
      row /= lower_(j, j);
      inverse[static_cast<std::size_t>(j)] = row;
      sum += row.square();
    }
    squares.segment<kGroup>(first) = sum;
  }
  return squares.head(size());
}

}  // namespace instep
