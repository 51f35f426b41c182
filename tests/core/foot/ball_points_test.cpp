#include "core/foot/ball_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kLength = 250.0;

/// Walls round in height whose furthest places make a given border to either side of a foot: all
/// that the points of the ball are told from.
FootOutline outline_with(const std::function<double(double)>& medial,
                         const std::function<double(double)>& lateral, double noise_mm,
                         std::uint64_t seed, double length = kLength) {
  test::RandomNumbers random(seed);
  FootScan foot;
  constexpr double kRoundMm = 12.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0.0, length);
    const double angle = random.uniform(-0.5, 0.5) * std::numbers::pi;
    const double in = kRoundMm * (1.0 - std::cos(angle)) - noise_mm * random.normal();
    const bool is_medial = random.uniform() < 0.5;
    foot.cloud.positions.emplace_back(x, is_medial ? medial(x) - in : in - lateral(x),
                                      kRoundMm * (1.0 + std::sin(angle)));
  }
  foot.landmarks["pternion"].position_mm = Vector3d::Zero();
  foot.landmarks["acropodion"].position_mm = Vector3d(length, 0.0, 10.0);
  return FootOutline(foot);
}

/// A border that reaches furthest, by a parabola, at `place`.
std::function<double(double)> bulging(double place, double bend) {
  return [=](double x) { return 45.0 - 0.5 * bend * std::pow(x - place, 2); };
}

constexpr double kHandicapBend = 2.0 / (0.04 * 0.04 * kLength * kLength);  // per mm, as documented

/// Where the weighed border is highest: each of two parabolas has its say by its bend.
double weighed(double place, double bend, double usual) {
  return (bend * place + kHandicapBend * usual) / (bend + kHandicapBend);
}

TEST(BallPoints, StandWhereTheWeighedBorderReachesFurthest) {
  for (const double bend : {0.0, 0.003, 0.01, 0.03}) {
    SCOPED_TRACE(bend);
    const auto outline = outline_with(bulging(178.0, bend), bulging(150.0, bend), 0.0, 1);
    const auto tibiale = find_metatarsale_tibiale(outline);
    ASSERT_TRUE(tibiale);
    const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
    ASSERT_TRUE(fibulare);
    EXPECT_NEAR(tibiale->position_mm.x(), weighed(178.0, bend, 0.69 * kLength), 0.7);
    const double usual = std::min(0.63 * kLength, tibiale->position_mm.x() - 15.0);
    EXPECT_NEAR(fibulare->position_mm.x(), weighed(150.0, bend, usual), 0.7);
    EXPECT_NEAR(fibulare->position_mm.y(), bulging(150.0, bend)(fibulare->position_mm.x()) * -1.0,
                0.1);
  }
}

TEST(BallPoints, SayWhereOnlyTheProportionPlacesThem) {
  const auto straight = [](double) { return 45.0; };
  const auto flat = find_metatarsale_tibiale(outline_with(straight, straight, 0.0, 2));
  ASSERT_TRUE(flat);
  EXPECT_TRUE(flat->is_placed_by_proportion());
  const auto round = bulging(170.0, 0.02);
  const auto clear = find_metatarsale_tibiale(outline_with(round, round, 0.0, 2));
  ASSERT_TRUE(clear);
  EXPECT_FALSE(clear->is_placed_by_proportion());
}

TEST(BallPoints, DoNotJumpOnANearlyStraightBorder) {
  // The lateral border of some feet: hardly bent, and its furthest place near the end of the range.
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto outline = outline_with(bulging(172.0, 0.02), bulging(155.0, 0.004), 0.3, seed);
    const auto tibiale = find_metatarsale_tibiale(outline);
    ASSERT_TRUE(tibiale);
    const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
    ASSERT_TRUE(fibulare);
    EXPECT_NEAR(fibulare->position_mm.x(), weighed(155.0, 0.004, 0.63 * kLength), 2.0) << seed;
  }
}

TEST(BallPoints, OfASmallChildKeepTheirDistance) {
  // So short a foot has its tibiale less than 15 mm in front of where the search for the fibulare
  // begins in longer ones.
  constexpr double kShort = 120.0;
  const auto knuckle = [](double place) {
    return [=](double x) { return std::max(20.0, bulging(place, 0.3)(x)); };
  };
  const auto outline = outline_with(knuckle(66.0), knuckle(65.0), 0.0, 7, kShort);
  const auto tibiale = find_metatarsale_tibiale(outline);
  ASSERT_TRUE(tibiale);
  ASSERT_LT(tibiale->position_mm.x(), 0.5 * kShort + 15.0);
  const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
  ASSERT_TRUE(fibulare);
  EXPECT_NEAR(fibulare->position_mm.x(), tibiale->position_mm.x() - 15.0, 1e-6);
}

}  // namespace
}  // namespace instep
