#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/surface/heights/height_kriging.h"
#include "tests/support/kriging_by_lu.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using test::KrigingByLu;

constexpr KrigingByLu kModels[] = {{HeightKernel::kCubic, 3},
                                   {HeightKernel::kCubic, 6},
                                   {HeightKernel::kCubic, 10},
                                   {HeightKernel::kQuintic, 6},
                                   {HeightKernel::kSeptic, 10}};

/// Heights and slopes that do not quite agree, so that nothing comes out even.
HeightSamples wavy_samples(Index count, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  HeightSamples samples{Eigen::Matrix2Xd(2, count), VectorXd(count), VectorXd(count),
                        Eigen::Matrix2Xd(2, count)};
  for (Index i = 0; i < count; ++i) {
    const double x = random.uniform(-0.7, 0.7);
    const double y = random.uniform(-0.7, 0.7);
    samples.places.col(i) << x, y;
    samples.heights[i] = 0.3 * x + 0.1 * std::sin(5.0 * x + 4.0 * y) + 0.02 * random.normal();
    samples.variances[i] = random.uniform(1e-4, 9e-4);
    const double along = 0.1 * std::cos(5.0 * x + 4.0 * y);
    samples.slopes.col(i) << 0.3 + 5.0 * along + 0.1 * random.normal(),
        4.0 * along + 0.1 * random.normal();
  }
  return samples;
}

HeightSamples without_slopes(HeightSamples samples) {
  samples.slopes.resize(2, 0);
  return samples;
}

/// Of the readings for a roughness of one. A slope's own comes on top of `ratio`, which the least
/// certain height has.
VectorXd noise_of(const HeightSamples& samples, double ratio, double slope_ratio) {
  VectorXd noise = VectorXd::Constant(3 * samples.size(), ratio + slope_ratio);
  noise.head(samples.size()) = ratio / samples.variances.maxCoeff() * samples.variances;
  return noise;
}

std::optional<HeightKriging> kriging_of(const HeightSamples& samples, const KrigingByLu& model,
                                        double slope_ratio = 0.0) {
  return HeightKriging::of(samples, model.terms, model.kernel, slope_ratio);
}

/// A sum of heights at some places.
struct Sought {
  Eigen::Matrix2Xd places{2, 4};
  Eigen::Vector4d shares{0.5, -1.2, 2.0, 0.3};

  Sought() { places << 0.1, -0.4, 0.9, 0.2, 0.3, 0.0, -0.2, -0.6; }

  VectorXd beside(const HeightSamples& samples, const KrigingByLu& model) const {
    VectorXd sum = VectorXd::Zero(3 * samples.size() + model.terms);
    for (Index i = 0; i < 4; ++i) sum += shares[i] * model.beside(samples.places, places.col(i));
    return sum;
  }
  /// What its kernels share with one another.
  double own(const KrigingByLu& model) const {
    double sum = 0.0;
    for (Index i = 0; i < 4; ++i) {
      for (Index j = 0; j < 4; ++j) {
        sum += shares[i] * shares[j] * model.between(places.col(i), places.col(j))(0, 0);
      }
    }
    return sum;
  }
};

TEST(HeightKrigingSlopes, IsTheSolutionOfTheFullSystemByLu) {
  for (const auto& model : kModels) {
    for (const Index count : {8, 20, 40}) {
      for (const double ratio : {1e-6, 1e-2}) {
        for (const double slope_ratio : {0.0, 1e-4, 1.0}) {
          const auto samples = wavy_samples(count, 1);
          const auto kriging = kriging_of(samples, model, slope_ratio);
          ASSERT_TRUE(kriging);
          EXPECT_EQ(kriging->samples(), count);
          EXPECT_EQ(kriging->free(), 3 * count - model.terms);
          const auto solution = kriging->solve(ratio);
          ASSERT_TRUE(solution);
          const VectorXd expected = model.solution(samples, noise_of(samples, ratio, slope_ratio));
          const VectorXd weights = expected.head(3 * count);
          EXPECT_LT((kriging->weights(*solution) - weights).norm(), 1e-7 * weights.norm())
              << model.terms << " terms, " << count << " samples, " << ratio << " " << slope_ratio;
          const VectorXd polynomial = expected.tail(model.terms);
          EXPECT_LT((kriging->polynomial(*solution).head(model.terms) - polynomial).norm(),
                    1e-7 * std::max(1.0, polynomial.norm()));
        }
      }
    }
  }
}

TEST(HeightKrigingSlopes, VolumesAreThoseOfTheRestrictedLikelihood) {
  for (const auto& model : kModels) {
    for (const double slope_ratio : {1e-3, 0.1}) {
      const auto samples = wavy_samples(12, 2);
      const auto kriging = kriging_of(samples, model, slope_ratio).value();
      const auto solution = kriging.solve(1e-2).value();
      MatrixXd covariance = model.kernel_of(samples.places);
      covariance.diagonal() += noise_of(samples, 1e-2, slope_ratio);
      const MatrixXd block = model.polynomial_block(samples.places);
      const Eigen::FullPivLU<MatrixXd> lu(covariance);
      const MatrixXd information = block.transpose() * lu.solve(block);
      const double expected =
          std::log(std::abs(lu.determinant())) + std::log(std::abs(information.determinant()));
      EXPECT_NEAR(solution.log_volume + kriging.log_determined(), expected, 1e-6);
      EXPECT_NEAR(solution.excess, test::readings_of(samples).dot(kriging.weights(solution)), 1e-8);
    }
  }
}

/// From fewer samples than the cubic has terms.
TEST(HeightKrigingSlopes, FindsThePolynomialThatTheReadingsLieOn) {
  for (const auto& model : kModels) {
    auto samples = wavy_samples(8, 3);
    const VectorXd truth = VectorXd::LinSpaced(model.terms, -1.0, 2.0);
    for (Index i = 0; i < samples.size(); ++i) {
      const Eigen::Vector3d reading = model.terms_at(samples.places.col(i)) * truth;
      samples.heights[i] = reading[0];
      samples.slopes.col(i) = reading.tail<2>();
    }
    const auto kriging = kriging_of(samples, model, 1e-3);
    ASSERT_TRUE(kriging);
    const auto solution = kriging->solve(1e-3).value();
    EXPECT_LT((kriging->polynomial(solution).head(model.terms) - truth).norm(), 1e-9);
    EXPECT_LT(kriging->weights(solution).norm(), 1e-9);
  }
  EXPECT_FALSE(kriging_of(without_slopes(wavy_samples(8, 3)), kModels[4]));
}

TEST(HeightKrigingSlopes, InfluenceIsWhatMovingAReadingDoesToTheSum) {
  const Sought sought;
  for (const auto& model : kModels) {
    for (const double ratio : {1e-4, 0.05}) {
      const auto samples = wavy_samples(15, 4);
      const VectorXd noise = noise_of(samples, ratio, 0.01);
      const VectorXd beside = sought.beside(samples, model);
      const double before = beside.dot(model.solution(samples, noise));
      const auto kriging = kriging_of(samples, model, 0.01).value();
      const VectorXd influence =
          kriging.sums(kriging.solve(ratio).value(), sought.places, sought.shares).influence;
      ASSERT_EQ(influence.size(), 45);
      for (Index i = 0; i < 45; ++i) {
        auto moved = samples;
        (i < 15 ? moved.heights[i] : moved.slopes(i / 15 - 1, i % 15)) += 0.25;
        const double after = beside.dot(model.solution(moved, noise));
        EXPECT_NEAR(influence[i], (after - before) / 0.25, 1e-7) << "reading " << i;
      }
    }
  }
}

/// Universal kriging's variance, k - [k p] M^-1 [k p]' with M of eq. 7, less the heights' noise.
TEST(HeightKrigingSlopes, WanderingIsTheKrigingVarianceByDenseAlgebra) {
  const Sought sought;
  for (const auto& model : kModels) {
    for (const double slope_ratio : {0.0, 1e-2, 1.0}) {
      const double ratio = 1e-3;
      const auto samples = wavy_samples(20, 5);
      const VectorXd beside = sought.beside(samples, model);
      const MatrixXd system = model.system(samples.places, noise_of(samples, ratio, slope_ratio));
      const VectorXd solved = system.fullPivLu().solve(beside);
      const VectorXd noise = noise_of(samples, ratio, 0.0);
      const double expected =
          sought.own(model) - beside.dot(solved) - solved.head(60).cwiseAbs2().dot(noise);
      const auto kriging = kriging_of(samples, model, slope_ratio).value();
      const auto solution = kriging.solve(ratio).value();
      EXPECT_NEAR(kriging.sums(solution, sought.places, sought.shares).wandering[0], expected,
                  1e-8 + 1e-8 * expected);
      EXPECT_GT(expected, 1e-6);
    }
  }
}

double wandering_at(const HeightKriging& kriging, const Vector2d& place) {
  const auto solution = kriging.solve(1e-8).value();
  return kriging.sums(solution, place, VectorXd::Ones(1)).wandering[0];
}

TEST(HeightKrigingSlopes, WandersLessTheMoreExactTheSlopesAre) {
  test::RandomNumbers random(6);
  for (const auto& model : kModels) {
    const auto samples = wavy_samples(20, 6);
    for (int i = 0; i < 10; ++i) {
      const Vector2d place(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
      double more = wandering_at(kriging_of(without_slopes(samples), model).value(), place);
      for (const double slope_ratio : {1.0, 1e-2, 1e-4}) {
        const double less = wandering_at(kriging_of(samples, model, slope_ratio).value(), place);
        EXPECT_GE(less, 0.0);
        EXPECT_LT(less, more + 1e-9) << slope_ratio;
        more = less;
      }
    }
  }
}

TEST(HeightKrigingSlopes, WildSlopesSayNothing) {
  const Sought sought;
  for (const auto& model : kModels) {
    const auto samples = wavy_samples(30, 7);
    const auto sum_and_wandering = [&](const HeightKriging& kriging) {
      const auto solution = kriging.solve(1e-3).value();
      const auto sums = kriging.sums(solution, sought.places, sought.shares);
      const VectorXd readings =
          kriging.free() > 30 ? test::readings_of(samples) : VectorXd(samples.heights);
      return Vector2d(sums.influence.col(0).dot(readings), sums.wandering[0]);
    };
    const Vector2d bare = sum_and_wandering(kriging_of(without_slopes(samples), model).value());
    const Vector2d wild = sum_and_wandering(kriging_of(samples, model, 1e7).value());
    const Vector2d told = sum_and_wandering(kriging_of(samples, model).value());
    EXPECT_LT((wild - bare).norm(), 1e-4 * bare.norm());
    EXPECT_GT((told - bare).norm(), 1e-2 * bare.norm());
  }
}

}  // namespace
}  // namespace instep
