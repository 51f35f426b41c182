#pragma once

#include <Eigen/Core>
#include <optional>

namespace instep {

/// Cholesky's method for systems of some fifty unknowns, where working block by block costs more
/// than it saves.
class SmallCholesky {
 public:
  SmallCholesky() = default;

  /// Of the symmetric matrix whose lower triangle is given. Nothing if it is not positive definite.
  /// O(n^3).
  static std::optional<SmallCholesky> of(const Eigen::MatrixXd& matrix);

  Eigen::Index size() const { return lower_.cols(); }

  /// The matrix times this is `right`. O(n^2).
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  /// Root' times a vector, whose square is the vector's with the matrix between. O(n^2).
  Eigen::VectorXd rooted(const Eigen::VectorXd& vector) const;

  /// Logarithm of the matrix's determinant.
  double log_volume() const;

  /// Diagonal of the inverse. O(n^3).
  Eigen::VectorXd inverse_diagonal() const;

 private:
  void solve_root(double* right) const;

  Eigen::MatrixXd lower_;  ///< the root, its rows filled up with zeros to whole groups
};

}  // namespace instep
