#include "core/foot/redrawn_landmarks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Values = std::vector<std::optional<double>>;

TEST(Redraws, GiveStudentsIntervalOfTheWhole) {
  // Four partings into halves of +1 and -1: a part has variance 2, the whole 1, with four degrees.
  const Values values{1.0, -1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0};
  EXPECT_NEAR(u95_of_redraws(values, 2).value(), 2.776, 0.01);
}

TEST(Redraws, HoldTheMeanOfThePartsInNineteenOfTwentyCases) {
  test::RandomNumbers random(5);
  constexpr int kCases = 4000;
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    Values parts;
    double mean = 0.0;
    for (int k = 0; k < 8; ++k) {
      parts.emplace_back(random.normal());
      mean += *parts.back() / 8.0;
    }
    if (std::abs(mean) <= u95_of_redraws(parts, 8).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

TEST(Redraws, SayNothingFromTooFew) {
  EXPECT_FALSE(u95_of_redraws({}, 2));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, 2.0}, 2));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, std::nullopt, 2.0, 3.0, std::nullopt, 1.0}, 2));
}

}  // namespace
}  // namespace instep
