#include "core/surface/noise/neighbourhood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

/// A bent sheet with waves of that height, and noise.
TangentView drawn(int count, double wave, double sigma, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  TangentView view;
  view.points.resize(3, count);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    const double height = 0.2 * x * x - 0.1 * x * y + wave * std::cos(5.0 * x);
    view.points.col(i) = Eigen::Vector3d(x, y, height + sigma * random.normal());
  }
  return view;
}

TEST(Neighbourhood, ShowsNoMoreNoiseThanAQuadraticLeavesOver) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const int count : {13, 25, 60}) {
      for (const double wave : {0.0, 0.01, 0.1}) {
        for (const double sigma : {0.0, 0.003, 0.05}) {
          const TangentView view = drawn(count, wave, sigma, seed);
          const auto here = neighbourhood_of(view);
          ASSERT_TRUE(here);
          EXPECT_LE(here->variance, (1.0 + 1e-9) * most_variance_in(view) + 1e-20);
        }
      }
    }
  }
}

/// Where there is no shape beside the quadratic, all of it is noise.
TEST(Neighbourhood, HasAllThatAQuadraticLeavesOverForItsMostNoise) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    sum += most_variance_in(drawn(60, 0.0, 0.05, seed)) / 20.0;
  }
  EXPECT_NEAR(std::sqrt(sum), 0.05, 0.003);
}

TEST(Neighbourhood, OfTooFewPointsMayShowAnyNoise) {
  EXPECT_EQ(most_variance_in(TangentView{}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(most_variance_in(drawn(5, 0.0, 0.1, 1)), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace instep
