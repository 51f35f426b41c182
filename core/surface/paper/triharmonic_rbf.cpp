#include "core/surface/paper/triharmonic_rbf.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

namespace instep {
namespace {

constexpr Eigen::Index kTerms = 4;
/// Directions in which the points spread less, against the widest, count as none.
constexpr double kFlattest = 1e-10;

/// Points in a ball of unit radius round their mean.
struct UnitBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 1.0;
  Eigen::Matrix3Xd positions;
};

UnitBall in_unit_ball(const std::vector<Eigen::Vector3d>& points) {
  UnitBall ball;
  ball.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  Eigen::Index column = 0;
  for (const auto& point : points) ball.positions.col(column++) = point;
  if (points.empty()) return ball;
  ball.centre = ball.positions.rowwise().mean();
  ball.positions.colwise() -= ball.centre;
  const double radius = ball.positions.colwise().norm().maxCoeff();
  if (radius > 0.0) ball.radius = radius;
  ball.positions /= ball.radius;
  return ball;
}

/// 1, x, y, z of each point, one a row.
Eigen::MatrixXd polynomial_block(const Eigen::Matrix3Xd& positions) {
  Eigen::MatrixXd block(positions.cols(), kTerms);
  block.col(0).setOnes();
  block.rightCols(3) = positions.transpose();
  return block;
}

Eigen::MatrixXd kernel_block(const Eigen::Matrix3Xd& positions) {
  const Eigen::Index count = positions.cols();
  Eigen::MatrixXd block(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto squared = (positions.colwise() - positions.col(j)).colwise().squaredNorm().array();
    block.col(j) = (squared * squared.sqrt()).transpose();
  }
  return block;
}

Eigen::Index rank_of_polynomial(const Eigen::Matrix3Xd& positions) {
  if (positions.cols() == 0) return 0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(polynomial_block(positions));
  qr.setThreshold(kFlattest);
  return qr.rank();
}

}  // namespace

std::optional<TriharmonicRbf> TriharmonicRbf::fit(const std::vector<Eigen::Vector3d>& points,
                                                  const std::vector<double>& values,
                                                  const std::vector<double>& lambdas) {
  UnitBall ball = in_unit_ball(points);
  if (rank_of_polynomial(ball.positions) < kTerms) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index free = count - kTerms;
  const double unit = std::pow(ball.radius, 3);

  Eigen::MatrixXd system = kernel_block(ball.positions);
  system.diagonal() += Eigen::Map<const Eigen::VectorXd>(lambdas.data(), count) / unit;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(polynomial_block(ball.positions));
  const auto basis = qr.householderQ().setLength(kTerms);
  system.applyOnTheLeft(basis.adjoint());
  system.applyOnTheRight(basis);
  Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(values.data(), count);
  right.applyOnTheLeft(basis.adjoint());

  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  if (free > 0) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(system.bottomRightCorner(free, free));
    if (cholesky.info() != Eigen::Success) return std::nullopt;
    weights.tail(free) = cholesky.solve(right.tail(free));
  }
  TriharmonicRbf rbf;
  rbf.polynomial_ =
      qr.matrixQR()
          .topLeftCorner(kTerms, kTerms)
          .triangularView<Eigen::Upper>()
          .solve(right.head(kTerms) - system.topRightCorner(kTerms, free) * weights.tail(free));
  weights.applyOnTheLeft(basis);
  if (!weights.allFinite() || !rbf.polynomial_.allFinite()) return std::nullopt;
  rbf.centre_ = ball.centre;
  rbf.radius_ = ball.radius;
  rbf.positions_ = std::move(ball.positions);
  rbf.weights_ = std::move(weights);
  return rbf;
}

double TriharmonicRbf::at(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d scaled = (place - centre_) / radius_;
  double sum = polynomial_[0] + polynomial_.tail<3>().dot(scaled);
  for (Eigen::Index i = 0; i < positions_.cols(); ++i) {
    const double squared = (scaled - positions_.col(i)).squaredNorm();
    sum += weights_[i] * squared * std::sqrt(squared);
  }
  return sum;
}

Eigen::Index rank_of_system(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Matrix3Xd positions = in_unit_ball(points).positions;
  return positions.cols() + rank_of_polynomial(positions);
}

bool has_unique_solution(const std::vector<Eigen::Vector3d>& points) {
  return rank_of_system(points) == static_cast<Eigen::Index>(points.size()) + kTerms;
}

}  // namespace instep
