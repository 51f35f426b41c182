#include "core/surface/heights/kriging_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <vector>

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

/// What the likelihood is made of, by Cholesky's method on the whole matrix.
struct DenseReading {
  double log_volume = 0.0;
  double excess = 0.0;
};

/// Where the least certain sample has that variance.
DenseReading dense_reading(const HeightSamples& samples, Index terms, double variance,
                           double roughness) {
  MatrixXd covariance = roughness * cubed_distances(samples);
  covariance.diagonal() += variance / samples.variances.maxCoeff() * samples.variances;
  const MatrixXd rest = null_space(monomials(samples.places, terms));
  const Eigen::LLT<MatrixXd> cholesky(rest.transpose() * covariance * rest);
  if (cholesky.info() != Eigen::Success) ADD_FAILURE() << "not positive definite";
  return {2.0 * cholesky.matrixLLT().diagonal().array().log().sum(),
          cholesky.matrixL().solve(rest.transpose() * samples.heights).squaredNorm()};
}

/// Twice the negative log of the restricted likelihood, but for a constant.
double dense_misfit(const HeightSamples& samples, Index terms, double variance, double roughness) {
  const DenseReading reading = dense_reading(samples, terms, variance, roughness);
  return reading.log_volume + reading.excess;
}

KrigingLikelihood likelihood_of(const HeightSamples& samples, Index terms) {
  return KrigingLikelihood(HeightKriging::of(samples, terms).value());
}

TEST(KrigingLikelihood, DiffersBetweenPairsAsTheWholeMatrixTells) {
  for (const bool even : {true, false}) {
    for (const Index terms : {3, 6}) {
      for (const Index count : {9, 24, 61}) {
        const auto samples = noisy_samples(count, even, 1);
        const auto likelihood = likelihood_of(samples, terms);
        const double first = likelihood.misfit(4e-4, 0.1);
        const double expected_first = dense_misfit(samples, terms, 4e-4, 0.1);
        for (const double variance : {1e-5, 4e-4, 1e-2}) {
          for (const double roughness : {1e-3, 0.1, 5.0}) {
            const double expected =
                dense_misfit(samples, terms, variance, roughness) - expected_first;
            EXPECT_NEAR(likelihood.misfit(variance, roughness) - first, expected,
                        1e-7 * (1.0 + std::abs(expected)))
                << count << " samples, variance " << variance << ", roughness " << roughness;
          }
        }
      }
    }
  }
}

TEST(KrigingLikelihood, TellsTheRoughnessThatFitsBestAtARatio) {
  for (const bool even : {true, false}) {
    const auto samples = noisy_samples(30, even, 2);
    const auto likelihood = likelihood_of(samples, 6);
    constexpr double kStep = 1.02;
    for (const double ratio : {1e-3, 1e-2, 0.3}) {
      double least = std::numeric_limits<double>::infinity();
      double best = 0.0;
      for (double roughness = 1e-5; roughness < 10.0; roughness *= kStep) {
        const double misfit = dense_misfit(samples, 6, ratio * roughness, roughness);
        if (misfit < least) {
          least = misfit;
          best = roughness;
        }
      }
      EXPECT_NEAR(std::log(likelihood.likeliest_roughness(ratio) / best), 0.0, std::log(kStep))
          << ratio;
    }
  }
}

/// The rungs from the first on, each so many times the last.
std::vector<double> rungs(double first, double step, int count) {
  std::vector<double> rungs;
  for (int i = 0; i < count; ++i) rungs.push_back(first * std::pow(step, i));
  return rungs;
}

/// Ladders of every length up to three groups of lanes, whose likeliest rung lies in every lane, or
/// off either end.
TEST(KrigingLikelihood, FindsTheLikeliestRoughnessOfALadder) {
  constexpr double kVariance = 4e-4;
  constexpr double kStep = 1.0 / 1.5;
  for (const bool even : {true, false}) {
    const auto samples = noisy_samples(30, even, 6);
    const auto likelihood = likelihood_of(samples, 6);
    for (const bool has_prior : {false, true}) {
      std::optional<KrigingLikelihood::Prior> prior;
      if (has_prior) prior = KrigingLikelihood::Prior{0.01, 0.5};
      std::set<std::size_t> places;
      for (int count = 1; count <= 24; ++count) {
        const auto ladder = rungs(1e-3 * std::pow(1.5, count), kStep, count);
        std::vector<double> misfits;
        for (const double roughness : ladder) {
          misfits.push_back(dense_misfit(samples, 6, kVariance, roughness));
          if (prior) misfits.back() += std::pow(std::log(roughness / 0.01) / 0.5, 2);
        }
        const auto place = static_cast<std::size_t>(
            std::min_element(misfits.begin(), misfits.end()) - misfits.begin());
        places.insert(place);
        const double found =
            likelihood.likeliest(kVariance, ladder.front(), 0.999 * ladder.back(), kStep, prior);
        EXPECT_NEAR(found / ladder[place], 1.0, 1e-9) << count << " rungs, prior " << has_prior;
      }
      EXPECT_GT(places.size(), 8U) << "each lane was the likeliest once";
    }
  }
}

TEST(KrigingLikelihood, FindsTheLikeliestNoiseOfALadder) {
  constexpr double kStep = 1.5;
  for (const bool even : {true, false}) {
    const auto samples = noisy_samples(60, even, 7);
    const auto likelihood = likelihood_of(samples, 3);
    const auto free = static_cast<double>(samples.size() - 3);
    std::set<std::size_t> places;
    for (int count = 1; count <= 24; ++count) {
      const auto ladder = rungs(0.1 * std::pow(kStep, -count), kStep, count);
      std::vector<double> misfits;
      std::vector<double> variances;
      for (const double ratio : ladder) {
        const DenseReading reading = dense_reading(samples, 3, ratio, 1.0);
        misfits.push_back(reading.log_volume + free * std::log(reading.excess / free));
        variances.push_back(ratio * reading.excess / free);
      }
      const auto place = static_cast<std::size_t>(std::min_element(misfits.begin(), misfits.end()) -
                                                  misfits.begin());
      places.insert(place);
      const double found =
          likelihood.likeliest_variance(ladder.front(), 1.001 * ladder.back(), kStep);
      EXPECT_NEAR(found / variances[place], 1.0, 1e-7) << count << " rungs";
    }
    EXPECT_GT(places.size(), 8U) << "each lane was the likeliest once";
  }
}

TEST(KrigingLikelihood, TellsWhenNothingIsLikelyAtAll) {
  auto samples = noisy_samples(20, true, 8);
  samples.heights[3] = 1e200;
  const auto likelihood = likelihood_of(samples, 6);
  EXPECT_EQ(likelihood.likeliest(4e-4, 5.0, 1e-3, 0.5, std::nullopt), 5.0);
  EXPECT_EQ(likelihood.likeliest_variance(1e-3, 1.0, 1.5), 0.0);
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
