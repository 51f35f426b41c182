#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/surface/heights/height_kriging.h"
#include "tests/support/kriging_models.h"

namespace instep {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::full_system;
using test::kModels;
using test::terms_at;
using test::wavy_samples;
using Model = test::KrigingModel;

HeightSamples without(const HeightSamples& samples, Index gone) {
  const Index count = samples.size() - 1;
  HeightSamples rest{Eigen::Matrix2Xd(2, count), VectorXd(count), VectorXd(count)};
  for (Index i = 0, kept = 0; i < samples.size(); ++i) {
    if (i == gone) continue;
    rest.places.col(kept) = samples.places.col(i);
    rest.heights[kept] = samples.heights[i];
    rest.variances[kept++] = samples.variances[i];
  }
  return rest;
}

/// How far a sample is off what the others tell, and what is expected of that, squared.
struct LeftOut {
  double off;
  double expected;
};

LeftOut left_out_by_lu(const HeightSamples& samples, Index gone, double ratio, const Model& model) {
  const auto rest = without(samples, gone);
  VectorXd to_rest(rest.size() + model.terms);
  for (Index j = 0; j < rest.size(); ++j) {
    to_rest[j] = model.at(samples.places.col(gone), rest.places.col(j));
  }
  to_rest.tail(model.terms) = terms_at(samples.places.col(gone), model.terms).transpose();
  const VectorXd shares = full_system(rest, ratio, model).fullPivLu().solve(to_rest);
  return {samples.heights[gone] - shares.head(rest.size()).dot(rest.heights),
          ratio - shares.dot(to_rest)};
}

TEST(HeightKriging, LeftOutSamplesAreOffAsByFittingTheOthersAlone) {
  for (const Model& model : kModels) {
    for (const double ratio : {1e-7, 1e-3}) {
      auto samples = wavy_samples(25, 6);
      samples.variances.setConstant(1e-4);
      const auto kriging = model.of(samples).value();
      const double left_out = kriging.left_out(kriging.solve(ratio).value());
      double mean = 0.0;
      for (Index i = 0; i < samples.size(); ++i) {
        const auto one = left_out_by_lu(samples, i, ratio, model);
        mean += one.off * one.off / one.expected / static_cast<double>(samples.size());
      }
      EXPECT_NEAR(left_out / mean, 1.0, 1e-4) << ratio;
    }
  }
}

TEST(HeightKriging, MissesASampleByAsMuchAsTheOthersAloneDo) {
  for (const Model& model : kModels) {
    for (const double ratio : {1e-7, 1e-3}) {
      auto samples = wavy_samples(25, 6);
      samples.variances.head(2).setConstant(1e-3);  // the scale, whichever is left out
      const auto kriging = model.of(samples).value();
      const Eigen::ArrayXd missed = kriging.missed(kriging.solve(ratio).value());
      ASSERT_EQ(missed.size(), samples.size());
      for (Index i = 0; i < samples.size(); ++i) {
        const double off = left_out_by_lu(samples, i, ratio, model).off;
        EXPECT_NEAR(missed[i], off, 1e-4 * std::abs(off) + 1e-9) << i << " " << ratio;
      }
    }
  }
}

/// Of twice the log likelihood of the others, with the roughness that fits them best, if each in
/// turn is left out: what is off by that is held against as many free readings as before.
VectorXd gains_by_fitting_the_others(const HeightSamples& samples, double ratio,
                                     const Model& model) {
  const auto excess_of = [&](const HeightSamples& some) {
    return model.of(some).value().solve(ratio).value().excess;
  };
  const auto free = static_cast<double>(samples.size() - model.terms);
  const double excess = excess_of(samples);
  VectorXd gains(samples.size());
  for (Index i = 0; i < samples.size(); ++i)
    gains[i] = free * std::log(excess / excess_of(without(samples, i)));
  return gains;
}

TEST(HeightKriging, OddOneIsThatWithoutWhichTheOthersAreLikeliest) {
  for (const Model& model : kModels) {
    for (const double ratio : {1e-6, 1e-2}) {
      for (const Index stray : {3, 17}) {
        auto samples = wavy_samples(30, 9);
        samples.variances.head(2).setConstant(1e-3);  // the scale, whichever is left out
        samples.heights[stray] += 0.3;
        const auto kriging = model.of(samples).value();
        const auto odd = kriging.odd_one(kriging.solve(ratio).value(), 0.0);
        const VectorXd gains = gains_by_fitting_the_others(samples, ratio, model);
        Index likeliest = 0;
        const double most = gains.maxCoeff(&likeliest);
        EXPECT_EQ(odd.sample, likeliest) << ratio;
        EXPECT_NEAR(odd.gain, most, 1e-5 * most) << ratio;
      }
    }
  }
}

TEST(HeightKriging, NoneIsOddThatIsHarmlesslyOff) {
  auto samples = wavy_samples(30, 10);
  samples.heights = 0.2 * samples.places.row(0).transpose();
  const auto gain_of = [&] {
    const auto kriging = HeightKriging::of(samples, 6).value();
    return kriging.odd_one(kriging.solve(1e-6).value(), 0.01).gain;
  };
  EXPECT_EQ(gain_of(), 0.0) << "on the polynomial";
  samples.heights[4] += 0.005;
  EXPECT_EQ(gain_of(), 0.0);
  samples.heights[4] += 0.05;
  EXPECT_GT(gain_of(), 30.0);
}

/// One that is left free takes all of the excess.
TEST(HeightKriging, NoneIsOddOfFew) {
  auto samples = wavy_samples(7, 12);
  samples.heights[3] += 0.5;
  const auto kriging = HeightKriging::of(samples, 6).value();
  EXPECT_EQ(kriging.odd_one(kriging.solve(1e-6).value(), 0.0).gain, 0.0);
}

}  // namespace
}  // namespace instep
