#include "core/repeatability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace instep {
namespace {

TEST(Repeatability, GivesTheFiguresOfATextbook) {
  // Squares of the deviations from 5: 9 1 1 1 0 0 4 16, together 32.
  const auto figures = repeatability({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(figures.mean, 5.0);
  EXPECT_DOUBLE_EQ(figures.standard_deviation, std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(figures.range(), 7.0);
  EXPECT_EQ(figures.values.front(), 2.0);
}

TEST(Repeatability, OfTwoIsTheirDifference) {
  const auto figures = repeatability({251.5, 250.0});
  EXPECT_DOUBLE_EQ(figures.mean_absolute_difference, 1.5);
  EXPECT_DOUBLE_EQ(figures.range(), 1.5);
  EXPECT_DOUBLE_EQ(figures.standard_deviation, 1.5 / std::numbers::sqrt2);
}

TEST(Repeatability, MeanAbsoluteDifferenceIsThatOfAllPairs) {
  std::mt19937_64 random(20);
  std::normal_distribution<double> noise(250.0, 0.5);
  std::vector<double> values(41);
  for (auto& value : values) value = noise(random);
  double sum = 0.0;
  int pairs = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = i + 1; j < values.size(); ++j, ++pairs) {
      sum += std::abs(values[i] - values[j]);
    }
  }
  EXPECT_NEAR(repeatability(values).mean_absolute_difference, sum / pairs, 1e-12);
}

TEST(Repeatability, OfNormalNoiseFollowsItsSigma) {
  // Of a normal law, two values differ by 2 / sqrt(pi) sigma in the mean.
  std::mt19937_64 random(21);
  std::normal_distribution<double> noise(240.0, 0.3);
  std::vector<double> values(20000);
  for (auto& value : values) value = noise(random);
  const auto figures = repeatability(values);
  EXPECT_NEAR(figures.standard_deviation, 0.3, 0.01);
  EXPECT_NEAR(figures.mean_absolute_difference, 0.3 * 2.0 * std::numbers::inv_sqrtpi, 0.01);
}

TEST(Repeatability, OfEqualValuesIsNone) {
  const auto figures = repeatability({240.1, 240.1, 240.1});
  EXPECT_NEAR(figures.standard_deviation, 0.0, 1e-12);
  EXPECT_EQ(figures.mean_absolute_difference, 0.0);
  EXPECT_EQ(figures.range(), 0.0);
}

}  // namespace
}  // namespace instep
