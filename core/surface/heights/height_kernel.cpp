#include "core/surface/heights/height_kernel.h"

namespace instep {
namespace {

/// Of squared distances, by `factor`.
template <class Squares, class Factor, class Values>
void set_kernel(HeightKernel kernel, const Squares& squared, const Factor& factor,
                Values&& values) {
  switch (kernel) {
    case HeightKernel::kCubic:
      values = factor * squared * squared.sqrt();
      break;
    case HeightKernel::kQuintic:
      values = -factor * squared.square() * squared.sqrt();
      break;
    case HeightKernel::kSeptic:
      values = factor * squared.cube() * squared.sqrt();
      break;
  }
}

/// The kernel round one place and what its derivatives there are made of: the slope along an arm is
/// `first` times it, the second derivatives `first` and `second` times the products of two.
struct Radials {
  Eigen::ArrayXd along;
  Eigen::ArrayXd across;
  Eigen::ArrayXd value;
  Eigen::ArrayXd first;
  Eigen::ArrayXd second;
};

Radials radials_round(HeightKernel kernel, const Eigen::Matrix2Xd& samples,
                      const Eigen::Vector2d& place) {
  Radials radials;
  radials.along = samples.row(0).transpose().array() - place.x();
  radials.across = samples.row(1).transpose().array() - place.y();
  const Eigen::ArrayXd squared =
      (radials.along.square() + radials.across.square()).max(kLeastSquared);
  radials.value.resize(squared.size());
  set_kernel(kernel, squared, 1.0, radials.value);
  const double power = power_of(kernel);
  radials.first = power * radials.value / squared;
  radials.second = (power - 2.0) * radials.first / squared;
  return radials;
}

}  // namespace

Eigen::Index fewest_terms(HeightKernel kernel) {
  switch (kernel) {
    case HeightKernel::kCubic:
      break;
    case HeightKernel::kQuintic:
      return 6;
    case HeightKernel::kSeptic:
      return 10;
  }
  return 3;
}

double power_of(HeightKernel kernel) {
  switch (kernel) {
    case HeightKernel::kCubic:
      break;
    case HeightKernel::kQuintic:
      return 5.0;
    case HeightKernel::kSeptic:
      return 7.0;
  }
  return 3.0;
}

Eigen::MatrixXd kernel_between(HeightKernel kernel, const Eigen::Matrix2Xd& places,
                               const Eigen::ArrayXd& scales) {
  const Eigen::Index count = places.cols();
  const Eigen::ArrayXd x = places.row(0);
  const Eigen::ArrayXd y = places.row(1);
  Eigen::MatrixXd matrix(count, count);
  Eigen::ArrayXd squared(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Index rest = count - j;
    squared.tail(rest) = (x.tail(rest) - x[j]).square() + (y.tail(rest) - y[j]).square();
    set_kernel(kernel, squared.tail(rest), scales[j] * scales.tail(rest),
               matrix.col(j).tail(rest).array());
  }
  return matrix;
}

Eigen::MatrixXd sloped_kernel_between(HeightKernel kernel, const Eigen::Matrix2Xd& places,
                                      const Eigen::ArrayXd& scales) {
  const Eigen::Index count = places.cols();
  Eigen::MatrixXd matrix(3 * count, 3 * count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Radials radials = radials_round(kernel, places, places.col(j));
    auto height = matrix.col(j);
    height.head(count) = radials.value;
    height.segment(count, count) = radials.first * radials.along;
    height.tail(count) = radials.first * radials.across;
    auto along = matrix.col(count + j);
    along.segment(count, count) = -radials.first - radials.second * radials.along.square();
    along.tail(count) = -radials.second * radials.along * radials.across;
    auto across = matrix.col(2 * count + j);
    across.tail(count) = -radials.first - radials.second * radials.across.square();
  }
  const auto scaled = scales.matrix().asDiagonal();
  return scaled * matrix.triangularView<Eigen::Lower>().toDenseMatrix() * scaled;
}

Eigen::MatrixXd kernels_at(HeightKernel kernel, const Eigen::Matrix2Xd& samples,
                           const Eigen::Matrix2Xd& places) {
  const Eigen::ArrayXd x = samples.row(0);
  const Eigen::ArrayXd y = samples.row(1);
  Eigen::ArrayXd squared(samples.cols());
  Eigen::MatrixXd kernels(samples.cols(), places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    squared = (x - places(0, i)).square() + (y - places(1, i)).square();
    set_kernel(kernel, squared, 1.0, kernels.col(i).array());
  }
  return kernels;
}

Eigen::MatrixXd sloped_kernels_at(HeightKernel kernel, const Eigen::Matrix2Xd& samples,
                                  const Eigen::Matrix2Xd& places) {
  Eigen::MatrixXd kernels(3 * samples.cols(), places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Radials radials = radials_round(kernel, samples, places.col(i));
    kernels.col(i) << radials.value, radials.first * radials.along, radials.first * radials.across;
  }
  return kernels;
}

}  // namespace instep
