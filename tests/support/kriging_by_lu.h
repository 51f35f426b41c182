#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/surface/heights/height_kernel.h"
#include "core/surface/heights/height_samples.h"

namespace instep::test {

/// Eq. 7 for heights and slopes, dense and by a pivoted decomposition: the truth for what solves it
/// quickly. Readings are all heights, all slopes along x, all along y.
struct KrigingByLu {
  HeightKernel kernel = HeightKernel::kCubic;
  Eigen::Index terms = 6;  ///< of the polynomial

  /// What the height (row 0) and the slopes (1 and 2) at `a` share with those at `b`.
  Eigen::Matrix3d between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  /// The polynomial's terms and their slopes (rows as above).
  Eigen::Matrix<double, 3, Eigen::Dynamic> terms_at(const Eigen::Vector2d& place) const;

  Eigen::MatrixXd kernel_of(const Eigen::Matrix2Xd& places) const;
  Eigen::MatrixXd polynomial_block(const Eigen::Matrix2Xd& places) const;
  /// The kernel and the polynomial at a place as the height there reads them.
  Eigen::VectorXd beside(const Eigen::Matrix2Xd& places, const Eigen::Vector2d& place) const;

  /// All of eq. 7. `noise`: of the readings.
  Eigen::MatrixXd system(const Eigen::Matrix2Xd& places, const Eigen::VectorXd& noise) const;
  /// Weights of the readings, then the polynomial's coefficients.
  Eigen::VectorXd solution(const HeightSamples& samples, const Eigen::VectorXd& noise) const;
};

/// Of samples with slopes.
Eigen::VectorXd readings_of(const HeightSamples& samples);

}  // namespace instep::test
