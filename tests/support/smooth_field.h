#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace instep::test {

/// Gaussian random numbers over a rectangle from the origin to `size`: mean 0, standard deviation 1
/// and, of two places `d` apart, correlated by exp(-(d / reach)^2). White noise on a grid,
/// smoothed.
class SmoothField {
 public:
  SmoothField(double reach, const Eigen::Vector2d& size, std::uint64_t seed);

  double at(const Eigen::Vector2d& place) const;

 private:
  double reach_;
  double pitch_;
  Eigen::Index margin_;  ///< nodes beyond each edge, as far as the smoothing looks
  Eigen::MatrixXd white_;
};

/// Draws, one a column, of gaussian random numbers with this covariance.
Eigen::MatrixXd correlated_draws(const Eigen::MatrixXd& covariance, Eigen::Index draws,
                                 std::uint64_t seed);

}  // namespace instep::test
