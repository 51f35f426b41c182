#include "core/surface/kriging_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

HeightSamples noisy_samples(Index count, bool even, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  HeightSamples samples{Eigen::Matrix2Xd(2, count), VectorXd(count), VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const double x = random.uniform(-0.7, 0.7);
    const double y = random.uniform(-0.7, 0.7);
    samples.places.col(i) << x, y;
    samples.variances[i] = even ? 4e-4 : random.uniform(1e-4, 4e-4);
    samples.heights[i] =
        0.1 * std::sin(5.0 * x + 4.0 * y) + std::sqrt(samples.variances[i]) * random.normal();
  }
  return samples;
}

MatrixXd cubed_distances(const HeightSamples& samples) {
  MatrixXd cubes(samples.size(), samples.size());
  for (Index i = 0; i < samples.size(); ++i) {
    for (Index j = 0; j < samples.size(); ++j) {
      cubes(i, j) = std::pow((samples.places.col(i) - samples.places.col(j)).norm(), 3);
    }
  }
  return cubes;
}

/// Orthonormal columns on which no polynomial has a part.
MatrixXd null_space(const MatrixXd& polynomials) {
  const MatrixXd orthogonal = Eigen::HouseholderQR<MatrixXd>(polynomials).householderQ();
  return orthogonal.rightCols(polynomials.rows() - polynomials.cols());
}

/// Twice the negative log of the restricted likelihood, but for a constant, where the least certain
/// sample has that variance.
double misfit_by_eigenvalues(const HeightSamples& samples, Index terms, double variance,
                             double roughness) {
  MatrixXd covariance = roughness * cubed_distances(samples);
  covariance.diagonal() += variance / samples.variances.maxCoeff() * samples.variances;
  const MatrixXd rest = null_space(monomials(samples.places, terms));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(rest.transpose() * covariance * rest);
  const VectorXd along = solver.eigenvectors().transpose() * rest.transpose() * samples.heights;
  return (along.array().square() / solver.eigenvalues().array() +
          solver.eigenvalues().array().log())
      .sum();
}

KrigingLikelihood likelihood_of(const HeightSamples& samples, Index terms) {
  return KrigingLikelihood(HeightKriging::of(samples, terms).value());
}

TEST(KrigingLikelihood, DiffersBetweenPairsAsByEigenvalues) {
  for (const bool even : {true, false}) {
    for (const Index terms : {3, 6}) {
      for (const Index count : {9, 24, 61}) {
        const auto samples = noisy_samples(count, even, 1);
        const auto likelihood = likelihood_of(samples, terms);
        EXPECT_EQ(likelihood.free(), count - terms);
        const double first = likelihood.misfit(4e-4, 0.1);
        const double expected_first = misfit_by_eigenvalues(samples, terms, 4e-4, 0.1);
        for (const double variance : {1e-5, 4e-4, 1e-2}) {
          for (const double roughness : {1e-3, 0.1, 5.0}) {
            const double expected =
                misfit_by_eigenvalues(samples, terms, variance, roughness) - expected_first;
            EXPECT_NEAR(likelihood.misfit(variance, roughness) - first, expected,
                        1e-7 * (1.0 + std::abs(expected)))
                << count << " samples, variance " << variance << ", roughness " << roughness;
          }
        }
      }
    }
  }
}

TEST(KrigingLikelihood, ProfileFindsTheRoughnessThatFitsBest) {
  for (const bool even : {true, false}) {
    const auto samples = noisy_samples(30, even, 2);
    const auto likelihood = likelihood_of(samples, 6);
    constexpr double kStep = 1.02;
    double offset = std::numeric_limits<double>::quiet_NaN();
    for (const double ratio : {1e-3, 1e-2, 0.3}) {
      double least = std::numeric_limits<double>::infinity();
      double best = 0.0;
      for (double roughness = 1e-5; roughness < 10.0; roughness *= kStep) {
        const double misfit = misfit_by_eigenvalues(samples, 6, ratio * roughness, roughness);
        if (misfit < least) {
          least = misfit;
          best = roughness;
        }
      }
      const auto profile = likelihood.profile(ratio);
      EXPECT_NEAR(std::log(profile.roughness / best), 0.0, std::log(kStep)) << ratio;
      // The scan misses the least misfit by no more than half a step squared for each free sample.
      if (std::isnan(offset)) offset = profile.misfit - least;
      EXPECT_NEAR(profile.misfit - least, offset, 24.0 * 0.5 * std::pow(std::log(kStep), 2));
    }
  }
}

TEST(KrigingLikelihood, MeanDiagonalIsThatOfTheKernelWithoutPolynomials) {
  for (const Index terms : {3, 6}) {
    const auto samples = noisy_samples(40, true, 3);
    const MatrixXd rest = null_space(monomials(samples.places, terms));
    const MatrixXd kernel = rest.transpose() * cubed_distances(samples) * rest;
    EXPECT_NEAR(likelihood_of(samples, terms).mean_diagonal(), kernel.diagonal().mean(), 1e-10);
  }
}

/// The heights that a quadratic leaves are white noise: no roughness explains them better than the
/// least, and the noise that does is the one that was drawn.
TEST(KrigingLikelihood, TellsWhiteNoiseFromAWanderingSurface) {
  auto samples = noisy_samples(60, true, 4);
  test::RandomNumbers random(5);
  for (auto& height : samples.heights) height = 0.02 * random.normal();
  const auto likelihood = likelihood_of(samples, 6);
  EXPECT_LT(likelihood.misfit(4e-4, 1e-5), likelihood.misfit(4e-4, 1.0));
  EXPECT_LT(likelihood.misfit(4e-4, 1e-5), likelihood.misfit(1e-4, 1e-5));
  EXPECT_LT(likelihood.misfit(4e-4, 1e-5), likelihood.misfit(16e-4, 1e-5));
  const auto wavy = likelihood_of(noisy_samples(60, true, 4), 6);
  EXPECT_LT(wavy.misfit(4e-4, 1.0), wavy.misfit(4e-4, 1e-5));
}

}  // namespace
}  // namespace instep
