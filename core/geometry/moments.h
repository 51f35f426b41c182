#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace instep {

/// Sums over points round some origin, from which their middle and their flattest direction follow.
/// The origin lies among the points, or digits are lost.
struct Moments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& arm) {
    count += 1.0;
    sum += arm;
    squares += arm * arm.transpose();
  }

  /// Those of other points, whose origin lies at `shift` from this one's.
  void add(const Moments& other, const Eigen::Vector3d& shift) {
    count += other.count;
    squares += other.squares + shift * other.sum.transpose() + other.sum * shift.transpose() +
               other.count * shift * shift.transpose();
    sum += other.sum + other.count * shift;
  }

  Eigen::Vector3d middle() const { return sum / count; }

  /// The direction in which the points spread least; of either sign. At least one point.
  Eigen::Vector3d flattest() const {
    const Eigen::Matrix3d spread = squares - sum * sum.transpose() / count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(spread);  // in closed form: a millionth of a radian is far more than enough
    return axes.eigenvectors().col(0);
  }
};

}  // namespace instep
