#include "core/surface/noise/uneven_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr std::size_t kPlaces = 24;
constexpr double kCommon = 1e-4;  // a variance; the body is about one long
/// Heights that each place knows of, so that its logarithm is known to one part in ten.
constexpr int kHeights = 50;

/// On a ring, each with the likeliest variance of heights whose sigma is `times` the common one.
template <typename Times>
std::vector<NoiseWitness> witnesses(const Times& times, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<NoiseWitness> all;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPlaces;
    double squares = 0.0;
    for (int k = 0; k < kHeights; ++k) squares += std::pow(random.normal(), 2);
    const double ratio = std::pow(times(i), 2) * squares / kHeights;
    // Twice the log likelihood of normal heights, at their own variance less at the common one.
    const double gain = kHeights * (ratio - 1.0 - std::log(ratio));
    const Eigen::Vector3d place(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.0);
    all.push_back({place, kCommon, ratio * kCommon, gain});
  }
  return all;
}

double even(std::size_t) {
  return 1.0;
}

/// Of a place and those beside it.
template <typename Times>
double largest_beside(const Times& times, std::size_t i) {
  return std::max({times(i), times((i + 1) % kPlaces), times((i + kPlaces - 1) % kPlaces)});
}

TEST(UnevenNoise, IsNotSeenInEvenNoise) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    EXPECT_TRUE(uneven_noise(witnesses(even, seed)).empty()) << seed;
  }
}

constexpr double kClose = 0.45;  // of logarithms

/// Beside a step it may be that of either side.
template <typename Times>
void expect_met(const std::vector<LocalNoise>& known, const Times& truth) {
  ASSERT_EQ(known.size(), kPlaces);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    EXPECT_GT(std::log(known[i].times / truth(i)), -kClose) << "place " << i;
    EXPECT_LT(std::log(known[i].times / largest_beside(truth, i)), kClose) << "place " << i;
  }
}

TEST(UnevenNoise, OfAHalfOrAThirdIsMetWithItsSteps) {
  for (const std::size_t many : {kPlaces / 2, kPlaces / 3}) {
    for (const double times : {2.0, 3.0, 5.0, 0.5, 0.2}) {
      const auto truth = [&](std::size_t i) { return i < many ? times : 1.0; };
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(testing::Message() << many << " " << times << " " << seed);
        expect_met(uneven_noise(witnesses(truth, seed)), truth);
      }
    }
  }
}

/// Where a noise ends between two places is not known, and too little of it is worse than too much.
TEST(UnevenNoise, ReachesOverAStepByOnePlace) {
  for (const double times : {3.0, 5.0}) {
    const auto truth = [&](std::size_t i) { return i < kPlaces / 2 ? times : 1.0; };
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto known = uneven_noise(witnesses(truth, seed));
      ASSERT_EQ(known.size(), kPlaces);
      for (const std::size_t beside : {kPlaces / 2, kPlaces - 1}) {
        EXPECT_NEAR(std::log(known[beside].times / times), 0.0, kClose) << times << " " << seed;
      }
      EXPECT_NEAR(known[kPlaces / 2 + 1].times, 1.0, 0.5) << times << " " << seed;
    }
  }
}

/// Creases, strays: few places that contradict beyond all measure.
TEST(UnevenNoise, IsNotSeenInAFewOddPlaces) {
  auto all = witnesses(even, 1);
  for (const std::size_t odd : {2U, 3U, 11U, 12U, 13U, 20U}) {
    all[odd].variance = 1e4 * kCommon;
    all[odd].contradiction = 1e4;
  }
  EXPECT_TRUE(uneven_noise(all).empty());
}

TEST(UnevenNoise, DoesNotBelieveAPlaceThatIsNotSure) {
  const auto truth = [](std::size_t i) { return i < kPlaces / 2 ? 3.0 : 1.0; };
  auto all = witnesses(truth, 1);
  for (std::size_t i = 18; i < 24; ++i) {
    all[i].variance = 0.0;
    all[i].contradiction = 0.1;
  }
  const auto known = uneven_noise(all);
  ASSERT_EQ(known.size(), kPlaces);
  for (std::size_t i = 18; i < 23; ++i) EXPECT_NEAR(known[i].times, 1.0, 0.3);
  EXPECT_NEAR(known[23].times, 3.0, 0.9) << "beside the noisier half";
}

TEST(UnevenNoise, IsNotLookedForInTheTextureOfExactPoints) {
  const auto truth = [](std::size_t i) { return i < kPlaces / 2 ? 5.0 : 1.0; };
  auto all = witnesses(truth, 1);
  ASSERT_FALSE(uneven_noise(all).empty());
  for (auto& witness : all) {
    witness.variance *= 1e-4;
    witness.expected *= 1e-4;
  }
  EXPECT_TRUE(uneven_noise(all).empty());
  EXPECT_TRUE(uneven_noise({}).empty());
}

TEST(NoiseBeyondTold, IsNotSeenWhereWhatIsToldIsRightOrTooMuch) {
  const auto half = [](std::size_t i) { return i < kPlaces / 2 ? 0.3 : 1.0; };
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    EXPECT_TRUE(noise_beyond_told(witnesses(even, seed)).empty()) << seed;
    EXPECT_TRUE(noise_beyond_told(witnesses(half, seed)).empty()) << seed;
  }
}

/// What is told of a third is right, of a third too little and of a third too much.
TEST(NoiseBeyondTold, IsMetWhereItIsAndNowhereElse) {
  for (const double times : {2.0, 3.0, 5.0, 100.0}) {
    const auto truth = [&](std::size_t i) {
      return i < kPlaces / 3 ? times : i < 2 * kPlaces / 3 ? 1.0 : 0.3;
    };
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(testing::Message() << times << " " << seed);
      expect_met(noise_beyond_told(witnesses(truth, seed)),
                 [&](std::size_t i) { return std::max(truth(i), 1.0); });
    }
  }
}

TEST(NoiseBeyondTold, IsNotLookedForInTheTextureOfExactPoints) {
  const auto truth = [](std::size_t i) { return i < kPlaces / 2 ? 5.0 : 1.0; };
  auto all = witnesses(truth, 1);
  for (auto& witness : all) {
    witness.variance *= 1e-6;
    witness.expected *= 1e-6;
  }
  EXPECT_TRUE(noise_beyond_told(all).empty());
}

TEST(UnevenNoise, IsUsuallyTheRootOfTheMeanSquare) {
  EXPECT_DOUBLE_EQ(usual_times({{{0, 0, 0}, 1.0}, {{1, 0, 0}, 7.0}}), 5.0);
}

TEST(UnevenNoise, IsReadBetweenPlacesAsTheNearestHaveIt) {
  const std::vector<LocalNoise> known = {{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.4}};
  EXPECT_NEAR(times_at(known, {0, 0, 0}), 0.1, 1e-9);
  EXPECT_NEAR(times_at(known, {1, 0, 0}), 0.4, 1e-9);
  EXPECT_NEAR(times_at(known, {0.5, 0.2, 0.1}), 0.2, 1e-9);
  EXPECT_NEAR(times_at(known, {0.05, 0, 0}), 0.1, 0.001);
}

}  // namespace
}  // namespace instep
