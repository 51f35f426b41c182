#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace instep {

/// The radial basis function of the paper (eqs. 6 and 7): a sum of weights times r^3 over points,
/// and a linear polynomial, that takes given values at the points; where a point's lambda > 0 it
/// may miss the value, to be smoother.
///
/// The paper calls the matrix of eq. 7 positive definite. It is not: the polynomial block has zeros
/// on the diagonal, and r^3 in space is only conditionally positive definite of order 2, so that
/// for n points n eigenvalues are positive and four negative; Cholesky's factorisation fails at
/// the first pivot. It is positive definite where the last four equations of eq. 7 hold: for
/// weights in the null space of the transposed polynomial block. An orthonormal basis of that null
/// space, from a QR factorisation of the block, leaves n - 4 unknowns with a positive definite
/// matrix, and Cholesky's factorisation is right there: (1/6) n^3 multiplications, as the paper
/// counts.
///
/// Points are centred and scaled to a unit ball within: in millimetres the condition of eq. 7 is
/// up to 1e14, in that ball about 1e9. Results scale with the unit of length; lambda counts in its
/// third power, as r^3 does.
class TriharmonicRbf {
 public:
  /// As many values and lambdas as points, all finite, lambda >= 0, points distinct. Nothing where
  /// the solution is not unique (has_unique_solution()) or the points are too near each other to
  /// be told apart. O(n^3) time, O(n^2) memory.
  static std::optional<TriharmonicRbf> fit(const std::vector<Eigen::Vector3d>& points,
                                           const std::vector<double>& values,
                                           const std::vector<double>& lambdas);

  /// Eq. 6. O(n).
  double at(const Eigen::Vector3d& place) const;

 private:
  TriharmonicRbf() = default;

  Eigen::Vector3d centre_;
  double radius_ = 1.0;
  Eigen::Matrix3Xd positions_;  ///< centred and scaled
  Eigen::VectorXd weights_;
  Eigen::Vector4d polynomial_;
};

/// Rank of the matrix of eq. 7 for distinct points: the number of points and the rank of the
/// polynomial block (the paper's Table 1: 2, 4, 6, 8, n + 4 for points in general position). O(n).
Eigen::Index rank_of_system(const std::vector<Eigen::Vector3d>& points);

/// Eq. 9 for distinct points: full rank. The paper finds it for four points and more (Table 1),
/// which holds in general position; points in one plane never reach it, however many.
bool has_unique_solution(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
