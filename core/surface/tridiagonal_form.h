#pragma once

#include <Eigen/Core>

namespace instep {

/// A symmetric matrix seen from axes in which it has but three diagonals, and a vector seen from
/// there.
struct TridiagonalForm {
  Eigen::VectorXd diagonal;
  Eigen::VectorXd beside;  ///< one shorter
  Eigen::VectorXd vector;
};

/// Householder's reflections, for matrices of some fifty rows; `lower`: the triangle that is read.
/// O(n^3).
TridiagonalForm tridiagonal_form(const Eigen::MatrixXd& lower, const Eigen::VectorXd& vector);

}  // namespace instep
