#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <vector>

namespace instep {

/// The directions in which points spread, from the least to the most, and how far: sums of squares.
using SpreadAxes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

/// Whether points spread across their plane by less than `part` of what they do across their
/// longest line on it, as skin does and a heap does not. By sums of squares.
inline bool are_flat(const SpreadAxes& axes, double part) {
  return axes.eigenvalues()[0] < part * axes.eigenvalues()[1];
}

/// Whether they spread across that line by less than `part` of what they do along it: which way
/// their plane faces they do not tell. By sums of squares.
inline bool are_on_a_line(const SpreadAxes& axes, double part) {
  return axes.eigenvalues()[1] < part * axes.eigenvalues()[2];
}

/// Whether points lie as skin does: neither in a heap nor on a line, so that their flattest
/// direction is the skin's normal. Across their plane they spread by less than 39 % of what they do
/// across their longest line on it, and across that by at least 39 % of what they do along it.
inline bool lies_as_skin(const SpreadAxes& axes) {
  constexpr double kPart = 0.15;  // squared
  return are_flat(axes, kPart) && !are_on_a_line(axes, kPart);
}

/// Sums over points round some origin, from which their middle and their flattest direction follow.
/// The origin lies among the points, or digits are lost.
struct Moments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  ///< the lower triangle; the rest is nothing

  /// Of at least one point, round the first: their middle lies at that and middle(). O(n).
  static Moments of(const std::vector<Eigen::Vector3d>& points) {
    Moments moments;
    for (const auto& point : points) moments.add(point - points.front());
    return moments;
  }

  void add(const Eigen::Vector3d& arm) {
    count += 1.0;
    sum += arm;
    add_products(arm, arm);
  }

  /// Those of other points round their own middle, which lies at `arm`.
  void add(const Moments& others, const Eigen::Vector3d& arm) {
    const Eigen::Vector3d share = others.count * arm;
    count += others.count;
    sum += share;
    squares += others.squares;
    add_products(share, arm);
  }

  Eigen::Vector3d middle() const { return sum / count; }

  /// At least one point.
  SpreadAxes axes() const {
    Moments round_middle = *this;
    round_middle.add_products(-sum / count, sum);
    SpreadAxes axes;
    // In closed form: a millionth of a radian is far more than enough.
    axes.computeDirect(round_middle.squares);
    return axes;
  }

  /// The direction in which the points spread least; of either sign. At least one point.
  Eigen::Vector3d flattest() const { return axes().eigenvectors().col(0); }

  /// That in which they spread most; of either sign. At least one point.
  Eigen::Vector3d longest() const { return axes().eigenvectors().col(2); }

 private:
  void add_products(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      for (Eigen::Index row = column; row < 3; ++row) squares(row, column) += a[row] * b[column];
    }
  }
};

}  // namespace instep
