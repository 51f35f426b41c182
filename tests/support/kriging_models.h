#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/surface/heights/height_kriging.h"

namespace instep::test {

/// Random places of a plane with a wave on it, some noise, and random variances.
HeightSamples wavy_samples(Eigen::Index count, std::uint64_t seed);

/// A kernel with the polynomial that it is solved with.
struct KrigingModel {
  Eigen::Index terms;
  HeightKernel kernel = HeightKernel::kCubic;

  double at(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  std::optional<HeightKriging> of(const HeightSamples& samples) const {
    return HeightKriging::of(samples, terms, kernel);
  }
};

inline constexpr KrigingModel kModels[] = {
    {3}, {6}, {10}, {6, HeightKernel::kQuintic}, {10, HeightKernel::kSeptic}};

/// The first monomials of a cubic polynomial.
Eigen::RowVectorXd terms_at(const Eigen::Vector2d& p, Eigen::Index terms);

/// Covariance of the samples for a roughness of one, with a noise of `ratio` times that of the
/// least certain one.
Eigen::MatrixXd covariance_of(const HeightSamples& samples, double ratio,
                              const KrigingModel& model);

Eigen::MatrixXd polynomial_block(const HeightSamples& samples, Eigen::Index terms);

/// All of eq. 7.
Eigen::MatrixXd full_system(const HeightSamples& samples, double ratio, const KrigingModel& model);

}  // namespace instep::test
