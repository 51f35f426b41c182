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
  static std::optional<SmallCholesky> of(Eigen::MatrixXd matrix);

  Eigen::Index size() const { return lower_.cols(); }

  /// The matrix times this is `right`. O(n^2).
  Eigen::VectorXd solve(Eigen::VectorXd right) const;

  /// Root' times a vector, whose square is the vector's with the matrix between. O(n^2).
  Eigen::VectorXd rooted(const Eigen::VectorXd& vector) const;

  /// Logarithm of the matrix's determinant.
  double log_volume() const;

  /// Diagonal of the inverse. O(n^3).
  Eigen::VectorXd inverse_diagonal() const;

 private:
  Eigen::MatrixXd lower_;  ///< the root; what stands over its diagonal means nothing
};

}  // namespace instep
