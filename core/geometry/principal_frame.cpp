#include "core/geometry/principal_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/mean.h"

namespace instep {
namespace {

/// The axis or its opposite, whichever has its largest component positive.
Eigen::Vector3d with_fixed_sign(const Eigen::Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

}  // namespace

PointSpread spread_of(const std::vector<Eigen::Vector3d>& points) {
  PointSpread spread;
  spread.mean = mean_of(points);
  for (const auto& point : points) {
    const Eigen::Vector3d offset = point - spread.mean;
    spread.covariance += offset * offset.transpose();
  }
  spread.covariance /= static_cast<double>(std::max<std::size_t>(points.size(), 2) - 1);
  return spread;
}

RigidTransform principal_from_input(const std::vector<Eigen::Vector3d>& points) {
  const PointSpread spread = spread_of(points);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread.covariance);  // ascending
  RigidTransform input_from_principal = RigidTransform::Identity();
  const Eigen::Vector3d x = with_fixed_sign(axes.eigenvectors().col(2));
  const Eigen::Vector3d y = with_fixed_sign(axes.eigenvectors().col(1));
  input_from_principal.linear() << x, y, x.cross(y);
  input_from_principal.translation() = spread.mean;
  return input_from_principal.inverse();
}

}  // namespace instep
