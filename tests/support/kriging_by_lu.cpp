#include "tests/support/kriging_by_lu.h"

#include <Eigen/LU>
#include <cmath>

namespace instep::test {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

Eigen::Matrix3d KrigingByLu::between(const Vector2d& a, const Vector2d& b) const {
  const int power = kernel == HeightKernel::kCubic ? 3 : kernel == HeightKernel::kQuintic ? 5 : 7;
  const double sign = power == 5 ? -1.0 : 1.0;
  const Vector2d arm = a - b;
  const double distance = arm.norm();
  const Vector2d slope = sign * power * std::pow(distance, power - 2) * arm;
  const Eigen::Matrix2d bend =
      sign * power * std::pow(distance, power - 2) * Eigen::Matrix2d::Identity() +
      sign * power * (power - 2) * std::pow(distance, power - 3) * arm * arm.transpose() /
          (distance > 0.0 ? distance : 1.0);
  Eigen::Matrix3d block;
  block(0, 0) = sign * std::pow(distance, power);
  block.block<2, 1>(1, 0) = slope;
  block.block<1, 2>(0, 1) = -slope.transpose();
  block.block<2, 2>(1, 1) = -bend;
  return block;
}

Eigen::Matrix<double, 3, Eigen::Dynamic> KrigingByLu::terms_at(const Vector2d& place) const {
  const double x = place.x();
  const double y = place.y();
  Eigen::Matrix<double, 3, 10> all;
  all << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y,  //
      0, 1, 0, 2 * x, y, 0, 3 * x * x, 2 * x * y, y * y, 0,                         //
      0, 0, 1, 0, x, 2 * y, 0, x * x, 2 * x * y, 3 * y * y;
  return all.leftCols(terms);
}

MatrixXd KrigingByLu::kernel_of(const Matrix2Xd& places) const {
  const Index count = places.cols();
  MatrixXd matrix(3 * count, 3 * count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < count; ++j) {
      const Eigen::Matrix3d block = between(places.col(i), places.col(j));
      for (Index row = 0; row < 3; ++row) {
        for (Index column = 0; column < 3; ++column) {
          matrix(row * count + i, column * count + j) = block(row, column);
        }
      }
    }
  }
  return matrix;
}

MatrixXd KrigingByLu::polynomial_block(const Matrix2Xd& places) const {
  const Index count = places.cols();
  MatrixXd block(3 * count, terms);
  for (Index i = 0; i < count; ++i) {
    for (Index row = 0; row < 3; ++row)
      block.row(row * count + i) = terms_at(places.col(i)).row(row);
  }
  return block;
}

VectorXd KrigingByLu::beside(const Matrix2Xd& places, const Vector2d& place) const {
  const Index count = places.cols();
  VectorXd beside(3 * count + terms);
  for (Index j = 0; j < count; ++j) {
    const Eigen::Matrix3d block = between(place, places.col(j));
    for (Index column = 0; column < 3; ++column) beside[column * count + j] = block(0, column);
  }
  beside.tail(terms) = terms_at(place).row(0).transpose();
  return beside;
}

MatrixXd KrigingByLu::system(const Matrix2Xd& places, const VectorXd& noise) const {
  const Index count = 3 * places.cols();
  MatrixXd system = MatrixXd::Zero(count + terms, count + terms);
  system.topLeftCorner(count, count) = kernel_of(places);
  system.diagonal().head(count) += noise;
  system.topRightCorner(count, terms) = polynomial_block(places);
  system.bottomLeftCorner(terms, count) = polynomial_block(places).transpose();
  return system;
}

VectorXd KrigingByLu::solution(const HeightSamples& samples, const VectorXd& noise) const {
  VectorXd right = VectorXd::Zero(3 * samples.size() + terms);
  right.head(3 * samples.size()) = readings_of(samples);
  return system(samples.places, noise).fullPivLu().solve(right);
}

VectorXd readings_of(const HeightSamples& samples) {
  VectorXd readings(3 * samples.size());
  readings << samples.heights, samples.slopes.row(0).transpose(), samples.slopes.row(1).transpose();
  return readings;
}

}  // namespace instep::test
