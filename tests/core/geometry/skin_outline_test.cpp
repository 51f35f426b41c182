#include "core/geometry/skin_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Places = std::vector<Eigen::Vector3d>;
using test::RandomNumbers;

constexpr double kHeight = 6.0;
constexpr double kSide = 3.0;
const Eigen::Vector2d kMiddle(3.0, -2.0);

/// Of an ellipse round the middle, twice as long as wide, from `half_turn` to each side of a
/// direction: as many on each square unit of it.
void add(double density, double half_turn, RandomNumbers& random, Places& places) {
  constexpr double kLong = 20.0;
  constexpr double kShort = 10.0;
  const auto count = std::lround(density * 2.0 * half_turn * kLong * kHeight);
  for (long i = 0; i < count; ++i) {
    const double turn = 0.5 + random.uniform(-half_turn, half_turn);
    const double stretch = std::hypot(kLong * std::sin(turn), kShort * std::cos(turn));
    if (random.uniform() > stretch / kLong) continue;
    places.emplace_back(kMiddle.x() + kLong * std::cos(turn), kMiddle.y() + kShort * std::sin(turn),
                        random.uniform(-0.5, 0.5) * kHeight);
  }
}

Places ring(double density) {
  RandomNumbers random(1);
  Places places;
  add(density, std::numbers::pi, random, places);
  return places;
}

double density_of(const Places& places) {
  return outline_of_skin(places, kHeight, kSide).density;
}

TEST(SkinOutline, HasTheDensityOfEvenPoints) {
  for (const double density : {0.5, 5.0, 50.0}) {
    EXPECT_NEAR(density_of(ring(density)), density, 0.3 * density);
  }
}

TEST(SkinOutline, HasTheDensityOfTheRestWhereAPartIsDense) {
  for (const double half_turn : {0.05, 0.5, 1.5}) {
    RandomNumbers random(2);
    Places places = ring(5.0);
    add(400.0, half_turn, random, places);
    EXPECT_NEAR(density_of(places), 5.0, 2.0) << half_turn;
  }
}

/// Ninety-five of a hundred points lie in a spot: the directions were taken from there.
TEST(SkinOutline, HasNotTheDensityOfASpotThatWasSeenAgainAndAgain) {
  for (const double sigma : {0.001, 0.3}) {
    RandomNumbers random(2);
    Places places = ring(0.5);
    const Eigen::Vector3d spot = places.front();
    const std::size_t times = 19 * places.size();
    for (std::size_t i = 0; i < times; ++i) {
      const Eigen::Vector3d off(random.normal(), random.normal(), random.normal());
      places.push_back(spot + sigma * off);
    }
    EXPECT_NEAR(density_of(places), 0.5, 0.25) << sigma;
  }
}

TEST(SkinOutline, HasNotTheDensityOfStraysFarOff) {
  RandomNumbers random(3);
  Places places = ring(20.0);
  for (int i = 0; i < 200; ++i) {
    places.emplace_back(random.uniform(-300.0, 300.0), random.uniform(-300.0, 300.0),
                        random.uniform(-3.0, 3.0));
  }
  EXPECT_NEAR(density_of(places), 20.0, 7.0);
}

TEST(SkinOutline, HasNoDensityWithoutPointsBesideTheMiddle) {
  EXPECT_EQ(density_of({}), 0.0);
  EXPECT_EQ(density_of(Places(9, {kMiddle.x(), kMiddle.y(), 1.0})), 0.0);
}

TEST(SkinOutline, RunsRoundTheSkin) {
  RandomNumbers random(4);
  Places places = ring(5.0);
  add(400.0, 0.5, random, places);
  for (int i = 0; i < 100; ++i) {
    places.emplace_back(random.uniform(-60.0, 60.0), random.uniform(-60.0, 60.0),
                        random.uniform(-3.0, 3.0));
  }
  const auto outline = outline_of_skin(places, kHeight, kSide);
  EXPECT_LT((outline.middle - kMiddle).norm(), 0.5);
  EXPECT_EQ(outline.places.size(), 64U);
  for (const auto& place : outline.places) {
    const Eigen::Vector2d arm = place - kMiddle;
    EXPECT_NEAR(std::hypot(arm.x() / 20.0, arm.y() / 10.0), 1.0, 0.1);
  }
}

}  // namespace
}  // namespace instep
