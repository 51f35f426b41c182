#include "core/surface/heights/height_kriging.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tests/support/kriging_models.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using test::covariance_of;
using test::full_system;
using test::kModels;
using test::polynomial_block;
using test::terms_at;
using test::wavy_samples;
using Model = test::KrigingModel;

/// A sum of heights at some places.
struct Sought {
  Eigen::Matrix2Xd places{2, 4};
  Eigen::Vector4d shares{0.5, -1.2, 2.0, 0.3};

  Sought() { places << 0.1, -0.4, 0.9, 0.2, 0.3, 0.0, -0.2, -0.6; }
};

double sum_of_heights(const HeightSamples& samples, double ratio, const Model& model,
                      const Sought& sought) {
  const auto kriging = model.of(samples).value();
  const auto solution = kriging.solve(ratio).value();
  const VectorXd weights = kriging.weights(solution);
  const Polynomial polynomial = kriging.polynomial(solution);
  double sum = 0.0;
  for (Index i = 0; i < sought.shares.size(); ++i) {
    const Vector2d place = sought.places.col(i);
    double height = terms_at(place, 10).dot(polynomial);
    for (Index j = 0; j < samples.size(); ++j) {
      height += weights[j] * model.at(place, samples.places.col(j));
    }
    sum += sought.shares[i] * height;
  }
  return sum;
}

TEST(HeightKriging, IsTheSolutionOfTheFullSystemByLu) {
  for (const Model& model : kModels) {
    const Index terms = model.terms;
    for (const Index count : {12, 20, 60}) {
      for (const double ratio : {1e-6, 1e-3, 0.1, 10.0}) {
        const auto samples = wavy_samples(count, 1);
        const auto kriging = model.of(samples);
        ASSERT_TRUE(kriging);
        EXPECT_DOUBLE_EQ(kriging->level(), samples.variances.maxCoeff());
        EXPECT_EQ(kriging->free(), count - terms);
        const auto solution = kriging->solve(ratio);
        ASSERT_TRUE(solution);
        VectorXd right = VectorXd::Zero(count + terms);
        right.head(count) = samples.heights;
        const VectorXd expected = full_system(samples, ratio, model).fullPivLu().solve(right);
        const VectorXd weights = expected.head(count);
        EXPECT_LT((kriging->weights(*solution) - weights).norm(), 1e-8 * weights.norm())
            << terms << " terms, " << count << " samples, ratio " << ratio;
        const Polynomial polynomial = kriging->polynomial(*solution);
        const double size = std::max(1.0, expected.tail(terms).norm());
        EXPECT_LT((polynomial.head(terms) - expected.tail(terms)).norm(), 1e-8 * size);
        EXPECT_EQ(polynomial.tail(10 - terms).norm(), 0.0);
      }
    }
  }
}

/// log det V + log det P' V^-1 P, of the covariance V and the polynomial block P, is what a
/// likelihood that integrates over the polynomial has for its volume.
TEST(HeightKriging, VolumesAreThoseOfTheRestrictedLikelihood) {
  for (const Model& model : kModels) {
    const Index terms = model.terms;
    for (const double ratio : {1e-3, 0.1, 10.0}) {
      const auto samples = wavy_samples(25, 2);
      const auto kriging = model.of(samples).value();
      const auto solution = kriging.solve(ratio).value();
      const MatrixXd covariance = covariance_of(samples, ratio, model);
      const MatrixXd block = polynomial_block(samples, terms);
      const Eigen::FullPivLU<MatrixXd> lu(covariance);
      const MatrixXd information = block.transpose() * lu.solve(block);
      const double expected = std::log(std::abs(lu.determinant() * information.determinant()));
      EXPECT_NEAR(solution.log_volume + kriging.log_determined(), expected, 1e-7);
      EXPECT_NEAR(solution.excess, samples.heights.dot(kriging.weights(solution)), 1e-9);
    }
  }
}

TEST(HeightKriging, KnowsNothingOfSamplesThatDetermineNoPlane) {
  for (const Vector2d& along : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(0.6, -0.8)}) {
    auto line = wavy_samples(20, 3);
    for (Index i = 0; i < line.size(); ++i) {
      line.places.col(i) = Vector2d(0.1, 0.2) + line.places(0, i) * along;
    }
    EXPECT_FALSE(HeightKriging::of(line, 3));
    EXPECT_FALSE(HeightKriging::of(line, 6));
    line.places.col(7) += 0.3 * Vector2d(-along.y(), along.x());
    EXPECT_TRUE(HeightKriging::of(line, 3)) << "one sample beside the line";
  }
  EXPECT_FALSE(HeightKriging::of(wavy_samples(3, 4), 3));
  EXPECT_TRUE(HeightKriging::of(wavy_samples(4, 4), 3));
  EXPECT_FALSE(HeightKriging::of(wavy_samples(6, 4), 6)) << "nothing is left over the quadratic";
}

TEST(HeightKriging, TheQuinticKernelNeedsTheWholeQuadratic) {
  const auto samples = wavy_samples(20, 3);
  EXPECT_TRUE(HeightKriging::of(samples, 6, HeightKernel::kQuintic));
  EXPECT_FALSE(HeightKriging::of(samples, 3, HeightKernel::kQuintic));
  auto on_a_circle = samples;
  on_a_circle.places.colwise().normalize();
  EXPECT_TRUE(HeightKriging::of(on_a_circle, 6));
  EXPECT_FALSE(HeightKriging::of(on_a_circle, 6, HeightKernel::kQuintic));
}

TEST(HeightKriging, TheSepticKernelNeedsTheWholeCubic) {
  const auto samples = wavy_samples(20, 3);
  EXPECT_TRUE(HeightKriging::of(samples, 10, HeightKernel::kSeptic));
  EXPECT_FALSE(HeightKriging::of(samples, 6, HeightKernel::kSeptic));
  EXPECT_FALSE(HeightKriging::of(wavy_samples(10, 3), 10, HeightKernel::kSeptic));
  auto on_three_lines = samples;  // over which y (y - 0.3) (y + 0.3) is nothing
  for (Index i = 0; i < samples.size(); ++i) {
    on_three_lines.places(1, i) = 0.3 * static_cast<double>(i % 3 - 1);
  }
  EXPECT_TRUE(HeightKriging::of(on_three_lines, 6, HeightKernel::kQuintic));
  EXPECT_FALSE(HeightKriging::of(on_three_lines, 10, HeightKernel::kSeptic));
}

/// On a circle xx + yy is a constant: one of six terms too many.
TEST(HeightKriging, PassesThroughSamplesOnACircle) {
  auto samples = wavy_samples(16, 5);
  Sought at_samples;
  for (Index i = 0; i < samples.size(); ++i) {
    const double angle = 0.4 * static_cast<double>(i);
    samples.places.col(i) << 0.6 * std::cos(angle), 0.6 * std::sin(angle);
    samples.heights[i] = std::sin(3.0 * angle);
  }
  at_samples.places = samples.places.leftCols(4);
  EXPECT_NEAR(sum_of_heights(samples, 1e-10, Model{6}, at_samples),
              samples.heights.head(4).dot(at_samples.shares), 1e-6);
}

TEST(HeightKriging, InfluenceIsWhatMovingASampleDoesToTheSum) {
  const Sought sought;
  for (const Model& model : kModels) {
    for (const double ratio : {1e-4, 0.05, 2.0}) {
      const auto samples = wavy_samples(30, 6);
      const auto kriging = model.of(samples).value();
      const VectorXd influence =
          kriging.sums(kriging.solve(ratio).value(), sought.places, sought.shares).influence;
      ASSERT_EQ(influence.size(), 30);
      const double before = sum_of_heights(samples, ratio, model, sought);
      for (Index i = 0; i < samples.size(); ++i) {
        auto moved = samples;
        moved.heights[i] += 0.25;
        const double after = sum_of_heights(moved, ratio, model, sought);
        EXPECT_NEAR(influence[i], (after - before) / 0.25, 1e-8) << "sample " << i;
      }
    }
  }
}

TEST(HeightKriging, LeverageIsThatOfTheOnlyPointBesideALine) {
  auto samples = wavy_samples(20, 11);
  EXPECT_LT(HeightKriging::of(samples, 3)->most_leverage(), 0.7);
  samples.places.row(1).setZero();
  samples.places(1, 6) = 0.5;
  EXPECT_NEAR(HeightKriging::of(samples, 3)->most_leverage(), 1.0, 1e-9);
}

/// The variance of universal kriging, k - [k p] M^-1 [k p]' with M of eq. 7, less its noise.
TEST(HeightKriging, WanderingIsTheKrigingVarianceByDenseAlgebra) {
  const Sought sought;
  for (const Model& model : kModels) {
    const Index terms = model.terms;
    for (const double ratio : {1e-4, 0.05, 2.0}) {
      const auto samples = wavy_samples(30, 7);
      const Index count = samples.size();
      VectorXd beside = VectorXd::Zero(count + terms);
      double own = 0.0;
      for (Index i = 0; i < sought.shares.size(); ++i) {
        const Vector2d place = sought.places.col(i);
        const double share = sought.shares[i];
        for (Index j = 0; j < count; ++j)
          beside[j] += share * model.at(place, samples.places.col(j));
        beside.tail(terms) += share * terms_at(place, terms).transpose();
        for (Index j = 0; j < sought.shares.size(); ++j) {
          own += share * sought.shares[j] * model.at(place, sought.places.col(j));
        }
      }
      const VectorXd solved = full_system(samples, ratio, model).fullPivLu().solve(beside);
      const VectorXd noise = ratio / samples.variances.maxCoeff() * samples.variances;
      const double expected = own - beside.dot(solved) - solved.head(count).cwiseAbs2().dot(noise);

      const auto kriging = model.of(samples).value();
      const auto solution = kriging.solve(ratio).value();
      EXPECT_NEAR(kriging.sums(solution, sought.places, sought.shares).wandering[0], expected,
                  1e-8 + 1e-8 * expected);
      EXPECT_GT(expected, 1e-3);
    }
  }
}

TEST(HeightKriging, HardlyWandersAtASampleAndMoreTheFurtherFromAll) {
  const auto samples = wavy_samples(40, 8);
  const auto kriging = HeightKriging::of(samples, 6).value();
  const auto solution = kriging.solve(1e-9).value();
  const auto wandering_at = [&](const Vector2d& place) {
    return kriging.sums(solution, place, VectorXd::Ones(1)).wandering[0];
  };
  for (Index i = 0; i < 5; ++i) EXPECT_LT(wandering_at(samples.places.col(i)), 1e-7);
  EXPECT_GT(wandering_at({1.0, 0.0}), 1e-3);
  EXPECT_GT(wandering_at({1.5, 0.0}), 3.0 * wandering_at({1.0, 0.0}));
}

}  // namespace
}  // namespace instep
