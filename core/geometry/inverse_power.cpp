#include "core/geometry/inverse_power.h"

#include <Eigen/LU>
#include <cmath>

namespace instep {
namespace {

/// Against the trace.
constexpr double kShift = 1e-9;
constexpr int kMostSteps = 100;
/// A direction that turns less in a step has converged.
constexpr double kStillTurn = 1e-14;

}  // namespace

Eigen::Vector3d smallest_axis(const Eigen::Matrix3d& covariance) {
  const double trace = covariance.trace();
  if (!(trace > 0.0) || !covariance.allFinite()) return Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d inverse =
      (covariance / trace + kShift * Eigen::Matrix3d::Identity()).inverse();
  // The longest column is the first step from the axis that points best along the answer.
  Eigen::Index longest = 0;
  inverse.colwise().squaredNorm().maxCoeff(&longest);
  Eigen::Vector3d axis = inverse.col(longest).normalized();
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector3d next = (inverse * axis).normalized();
    const double turn = (next - axis).squaredNorm();
    axis = next;
    if (turn < kStillTurn * kStillTurn) break;
  }
  return axis.allFinite() ? axis : Eigen::Vector3d::UnitZ();
}

}  // namespace instep
