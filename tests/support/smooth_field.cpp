#include "tests/support/smooth_field.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

constexpr Eigen::Index kNodesInReach = 3;
constexpr Eigen::Index kWindow = 2 * kNodesInReach;  // to each side; beyond it weights are 3e-4

Eigen::MatrixXd white_noise(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  RandomNumbers random(seed);
  Eigen::MatrixXd noise(rows, columns);
  for (auto& value : noise.reshaped()) value = random.normal();
  return noise;
}

}  // namespace

SmoothField::SmoothField(double reach, const Eigen::Vector2d& size, std::uint64_t seed)
    : reach_(reach), pitch_(reach / kNodesInReach), margin_(kWindow + 1) {
  const auto nodes = [&](double length) {
    return static_cast<Eigen::Index>(std::ceil(length / pitch_)) + 2 * margin_;
  };
  white_ = white_noise(nodes(size.x()), nodes(size.y()), seed);
}

double SmoothField::at(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d node = place / pitch_;
  const auto middle_x = static_cast<Eigen::Index>(std::round(node.x()));
  const auto middle_y = static_cast<Eigen::Index>(std::round(node.y()));
  double sum = 0.0;
  double squares = 0.0;
  for (Eigen::Index x = middle_x - kWindow; x <= middle_x + kWindow; ++x) {
    for (Eigen::Index y = middle_y - kWindow; y <= middle_y + kWindow; ++y) {
      const Eigen::Vector2d step(static_cast<double>(x) - node.x(),
                                 static_cast<double>(y) - node.y());
      // Convolved with itself it is the correlation that is wanted.
      const double weight = std::exp(-2.0 * (step * pitch_ / reach_).squaredNorm());
      sum += weight * white_(x + margin_, y + margin_);
      squares += weight * weight;
    }
  }
  return sum / std::sqrt(squares);
}

Eigen::MatrixXd correlated_draws(const Eigen::MatrixXd& covariance, Eigen::Index draws,
                                 std::uint64_t seed) {
  // Not by Cholesky: neighbours are so much alike that rounding makes it indefinite.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance);
  const Eigen::VectorXd roots = parts.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return parts.eigenvectors() * (roots.asDiagonal() * white_noise(covariance.rows(), draws, seed));
}

}  // namespace instep::test
