#include "core/foot/redrawn_landmarks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foot/alignment.h"
#include "core/foot/landmarks.h"
#include "tests/support/foot_body.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Values = std::vector<std::optional<double>>;

TEST(Redraws, GiveStudentsIntervalOfTheWhole) {
  // Four partings into halves of +1 and -1: a part has variance 2, the whole 1, with four degrees.
  const Values values{1.0, -1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0};
  EXPECT_NEAR(u95_of_redraws(values, {2, false}).value(), 2.776, 0.01);
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
    if (std::abs(mean) <= u95_of_redraws(parts, {8, false}).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

TEST(Redraws, ThatLeaveOutPartsHoldTheMeanInNineteenOfTwentyCases) {
  test::RandomNumbers random(6);
  constexpr int kCases = 4000;
  int held = 0;
  for (int i = 0; i < kCases; ++i) {
    double sum = 0.0;
    std::vector<double> parts;
    for (int k = 0; k < 8; ++k) sum += parts.emplace_back(random.normal());
    Values without;
    for (const double part : parts) without.emplace_back((sum - part) / 7.0);
    if (std::abs(sum / 8.0) <= u95_of_redraws(without, {8, true}).value()) ++held;
  }
  EXPECT_NEAR(static_cast<double>(held) / kCases, 0.95, 0.012);
}

TEST(Redraws, SayNothingFromTooFew) {
  EXPECT_FALSE(u95_of_redraws({}, {2, false}));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, 2.0}, {2, false}));
  EXPECT_FALSE(u95_of_redraws(Values{1.0, std::nullopt, 2.0, std::nullopt}, {4, true}));
}

TEST(Redraws, SayNothingWhereThereAreNone) {
  EXPECT_FALSE(u95_of_redraws({}, {}));
  EXPECT_FALSE(u95_by_redraws(1.0, {}, {}));
}

TEST(Redraws, ReachFromWhatWasToldToWhereTheyLie) {
  const Values values{1.0, -1.0, 1.0, -1.0, -1.0, std::nullopt, 1.0, -1.0};
  const double near = u95_by_redraws(0.0, values, {2, false}).value();
  EXPECT_GT(near, u95_of_redraws(values, {2, false}).value());
  EXPECT_NEAR(u95_by_redraws(7.0, values, {2, false}).value(), 7.0 + 1.0 / 7.0, 1e-9);
  EXPECT_NEAR(u95_by_redraws(-7.0, values, {2, false}).value(), 7.0 - 1.0 / 7.0, 1e-9);
}

/// They were other draws wherever a processor rounds otherwise.
TEST(Redraws, AreTheSameWhateverTheLastBitsOfPlaces) {
  const PointCloud cloud = test::FootBody{}.points();
  PointCloud rounded = cloud;
  for (auto& position : rounded.positions) position *= 1.0 + 1e-14;
  const auto draws = align_foot(cloud).and_then(find_landmarks).value().redraws.landmarks;
  const auto others = align_foot(rounded).and_then(find_landmarks).value().redraws.landmarks;
  ASSERT_FALSE(draws.empty());
  ASSERT_EQ(others.size(), draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (const auto& [name, landmark] : draws[i].landmarks) {
      const auto other = others[i].landmarks.find(name);
      ASSERT_NE(other, others[i].landmarks.end()) << name;
      EXPECT_NEAR((other->second.position_mm - landmark.position_mm).norm(), 0.0, 1e-4) << name;
    }
  }
}

TEST(Redraws, AreTheSameByWhateverWorkers) {
  const auto aligned = align_foot(test::FootBody{}.points()).value();
  const auto in_turn = find_landmarks(aligned).value();
  const Workers backwards = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    while (count-- > 0) work(count);
  };
  const auto other = find_landmarks_by(backwards, aligned).value();
  ASSERT_FALSE(in_turn.landmarks.empty());
  ASSERT_EQ(other.redraws.landmarks.size(), in_turn.redraws.landmarks.size());
  for (const auto& [name, landmark] : in_turn.landmarks) {
    EXPECT_EQ(other.landmarks.at(name).position_mm, landmark.position_mm) << name;
    EXPECT_EQ(other.landmarks.at(name).radius_mm, landmark.radius_mm) << name;
  }
}

}  // namespace
}  // namespace instep
