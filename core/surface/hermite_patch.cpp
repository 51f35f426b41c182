#include "core/surface/hermite_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace instep {
namespace {

/// Standard deviation granted to the unit slope along a normal: the field of a curved or creased
/// surface cannot have it everywhere.
constexpr double kSlopeDeviation = 0.05;
/// Least smoothing, against a unit kernel: keeps the system solvable where points nearly coincide.
constexpr double kLeastSmoothing = 1e-10;

/// The kernel r^3 between all data: values first, then slopes along the normals.
Eigen::MatrixXd kernel_matrix(const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& normals) {
  const Eigen::Index count = positions.cols();
  Eigen::MatrixXd kernel(2 * count, 2 * count);
  for (Eigen::Index j = 0; j < count; ++j) {
    for (Eigen::Index i = j; i < count; ++i) {
      const Eigen::Vector3d offset = positions.col(i) - positions.col(j);
      const double r = offset.norm();
      const double along_i = offset.dot(normals.col(i));
      const double along_j = offset.dot(normals.col(j));
      const double both = r > 0.0 ? along_i * along_j / r : 0.0;
      kernel(i, j) = kernel(j, i) = r * r * r;
      kernel(count + i, j) = kernel(j, count + i) = 3.0 * r * along_i;
      kernel(count + j, i) = kernel(i, count + j) = -3.0 * r * along_j;
      kernel(count + i, count + j) = kernel(count + j, count + i) =
          -3.0 * (both + r * normals.col(i).dot(normals.col(j)));
    }
  }
  return kernel;
}

Eigen::MatrixXd polynomial_block(const Eigen::Matrix3Xd& positions,
                                 const Eigen::Matrix3Xd& normals) {
  const Eigen::Index count = positions.cols();
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(2 * count, 4);
  block.col(0).head(count).setOnes();
  block.topRightCorner(count, 3) = positions.transpose();
  block.bottomRightCorner(count, 3) = normals.transpose();
  return block;
}

}  // namespace

std::optional<HermitePatch> HermitePatch::fit(const std::vector<OrientedPoint>& points,
                                              const Eigen::Vector3d& centre, double radius,
                                              double roughness) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count < 4 || !(radius > 0.0)) return std::nullopt;
  HermitePatch patch;
  patch.centre_ = centre;
  patch.radius_ = radius;
  patch.positions_.resize(3, count);
  patch.normals_.resize(3, count);
  Eigen::VectorXd smoothing(2 * count);
  const double unit = std::max(roughness * radius, 1e-12);
  for (Eigen::Index i = 0; i < count; ++i) {
    const OrientedPoint& point = points[static_cast<std::size_t>(i)];
    patch.positions_.col(i) = (point.position - centre) / radius;
    patch.normals_.col(i) = point.normal;
    smoothing[i] = std::max(point.variance / (radius * radius * unit), kLeastSmoothing);
    smoothing[count + i] = kSlopeDeviation * kSlopeDeviation / unit;
  }

  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(
      polynomial_block(patch.positions_, patch.normals_));
  const Eigen::Matrix4d upper = qr.matrixQR().topRows<4>().triangularView<Eigen::Upper>();
  if (upper.diagonal().cwiseAbs().minCoeff() < 1e-6 * upper.diagonal().cwiseAbs().maxCoeff()) {
    return std::nullopt;
  }
  Eigen::MatrixXd system = kernel_matrix(patch.positions_, patch.normals_);
  system.diagonal() += smoothing;
  system.applyOnTheLeft(qr.householderQ().adjoint());
  system.applyOnTheRight(qr.householderQ());
  Eigen::VectorXd data(2 * count);
  data << Eigen::VectorXd::Zero(count), Eigen::VectorXd::Ones(count);
  data.applyOnTheLeft(qr.householderQ().adjoint());

  const Eigen::Index free = 2 * count - 4;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(system.bottomRightCorner(free, free));
  if (cholesky.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(2 * count);
  weights.tail(free) = cholesky.solve(data.tail(free));
  const Eigen::Vector4d rest = data.head<4>() - system.topRows<4>() * weights;
  patch.polynomial_ = upper.triangularView<Eigen::Upper>().solve(rest);
  weights.applyOnTheLeft(qr.householderQ());
  if (!weights.allFinite() || !patch.polynomial_.allFinite()) return std::nullopt;
  patch.value_weights_ = weights.head(count);
  patch.slope_weights_ = weights.tail(count);
  return patch;
}

FieldValue HermitePatch::at(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d place = (position - centre_) / radius_;
  double value = polynomial_[0] + polynomial_.tail<3>().dot(place);
  Eigen::Vector3d gradient = polynomial_.tail<3>();
  for (Eigen::Index j = 0; j < positions_.cols(); ++j) {
    const Eigen::Vector3d offset = place - positions_.col(j);
    const double r = offset.norm();
    const double along = offset.dot(normals_.col(j));
    value += r * (r * r * value_weights_[j] - 3.0 * along * slope_weights_[j]);
    const double inverse = r > 0.0 ? 1.0 / r : 0.0;
    gradient += 3.0 * (r * value_weights_[j] - along * inverse * slope_weights_[j]) * offset -
                3.0 * r * slope_weights_[j] * normals_.col(j);
  }
  return {radius_ * value, gradient};
}

}  // namespace instep
