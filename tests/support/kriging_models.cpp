#include "tests/support/kriging_models.h"

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

HeightSamples wavy_samples(Index count, std::uint64_t seed) {
  RandomNumbers random(seed);
  HeightSamples samples{Eigen::Matrix2Xd(2, count), VectorXd(count), VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const Vector2d place(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
    samples.places.col(i) = place;
    samples.heights[i] = 0.3 * place.x() + 0.1 * std::sin(5.0 * place.x() + 4.0 * place.y()) +
                         0.02 * random.normal();
    samples.variances[i] = random.uniform(1e-4, 9e-4);
  }
  return samples;
}

double KrigingModel::at(const Vector2d& a, const Vector2d& b) const {
  const double distance = (a - b).norm();
  if (kernel == HeightKernel::kCubic) return std::pow(distance, 3);
  return kernel == HeightKernel::kQuintic ? -std::pow(distance, 5) : std::pow(distance, 7);
}

Eigen::RowVectorXd terms_at(const Vector2d& p, Index terms) {
  const double x = p.x();
  const double y = p.y();
  Eigen::RowVectorXd all(10);
  all << 1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return all.head(terms);
}

MatrixXd covariance_of(const HeightSamples& samples, double ratio, const KrigingModel& model) {
  MatrixXd covariance(samples.size(), samples.size());
  for (Index i = 0; i < samples.size(); ++i) {
    for (Index j = 0; j < samples.size(); ++j) {
      covariance(i, j) = model.at(samples.places.col(i), samples.places.col(j));
    }
    covariance(i, i) += ratio * samples.variances[i] / samples.variances.maxCoeff();
  }
  return covariance;
}

MatrixXd polynomial_block(const HeightSamples& samples, Index terms) {
  MatrixXd block(samples.size(), terms);
  for (Index i = 0; i < samples.size(); ++i) {
    block.row(i) = terms_at(samples.places.col(i), terms);
  }
  return block;
}

MatrixXd full_system(const HeightSamples& samples, double ratio, const KrigingModel& model) {
  const Index terms = model.terms;
  const Index count = samples.size();
  MatrixXd system = MatrixXd::Zero(count + terms, count + terms);
  system.topLeftCorner(count, count) = covariance_of(samples, ratio, model);
  system.topRightCorner(count, terms) = polynomial_block(samples, terms);
  system.bottomLeftCorner(terms, count) = polynomial_block(samples, terms).transpose();
  return system;
}

}  // namespace instep::test
