#include "core/geometry/piled_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Places = std::vector<Eigen::Vector3d>;
using test::RandomNumbers;

constexpr double kRadius = 10.0;
constexpr double kHeight = 6.0;
constexpr double kLeastSide = 0.5;
const Eigen::Vector2d kMiddle(3.0, -2.0);

/// Of a ring round the middle, from `half_angle` to each side of a direction: as many on each
/// square unit, with noise.
void add(double density, double half_angle, double sigma, RandomNumbers& random, Places& places) {
  const auto count = std::lround(density * 2.0 * half_angle * kRadius * kHeight);
  for (long i = 0; i < count; ++i) {
    const double angle = 0.5 + random.uniform(-half_angle, half_angle);
    const double radius = kRadius + sigma * random.normal();
    places.emplace_back(kMiddle.x() + radius * std::cos(angle),
                        kMiddle.y() + radius * std::sin(angle),
                        random.uniform(-0.5, 0.5) * kHeight);
  }
}

Places ring(double density, std::uint64_t seed = 1) {
  RandomNumbers random(seed);
  Places places;
  add(density, std::numbers::pi, 0.0, random, places);
  return places;
}

Places with_pile(double density, double of_pile, double half_angle, double sigma) {
  RandomNumbers random(7);
  Places places = ring(density);
  add(of_pile, half_angle, sigma, random, places);
  return places;
}

std::optional<PileLevel> level_of(const Places& places) {
  return level_beside_piles(places, kMiddle, kHeight, kLeastSide);
}

double density_of(const PileLevel& level) {
  return level.usual / (level.side * level.side);
}

double off_ring(const Eigen::Vector3d& place) {
  return (place.head<2>() - kMiddle).norm() - kRadius;
}

TEST(PiledPoints, AreNoneOfASkinThatIsSeenEvenly) {
  for (const double density : {0.3, 3.0, 100.0}) EXPECT_FALSE(level_of(ring(density)));
  EXPECT_FALSE(level_of({}));
  EXPECT_FALSE(level_of(Places(50, {kMiddle.x(), kMiddle.y(), 0.0})));
}

TEST(PiledPoints, AreTheDensePartWhetherTheRestIsSparseOrItCoversHalf) {
  for (const double density : {0.3, 3.0, 40.0}) {
    for (const double half_angle : {0.05, 0.4, 1.6}) {
      const auto level = level_of(with_pile(density, 80.0 * density, half_angle, 0.0));
      ASSERT_TRUE(level) << density << " " << half_angle;
      EXPECT_NEAR(density_of(*level), density, 0.5 * density);
      EXPECT_GE(level->side, kLeastSide);
      EXPECT_GE(level->usual, 0.999);
    }
  }
}

TEST(PiledPoints, AreNotTheSkinAmidStrays) {
  RandomNumbers random(2);
  Places places = ring(200.0);
  const std::size_t strays = places.size() / 5;
  for (std::size_t i = 0; i < strays; ++i) {
    places.emplace_back(kMiddle.x() + random.uniform(-14.0, 14.0),
                        kMiddle.y() + random.uniform(-14.0, 14.0), random.uniform(-3.0, 3.0));
  }
  EXPECT_FALSE(level_of(places));
}

TEST(PiledPoints, NeedWiderCellsWhereTheyAreThickWithNoise) {
  const auto thin = level_of(with_pile(6.0, 400.0, 0.5, 0.05));
  const auto thick = level_of(with_pile(6.0, 400.0, 0.5, 0.5));
  ASSERT_TRUE(thin && thick);
  EXPECT_EQ(thin->side, kLeastSide);
  EXPECT_GE(thick->side, 2.0 * kLeastSide);
  EXPECT_NEAR(density_of(*thick), density_of(*thin), 0.5);
}

TEST(PiledPoints, LeaveOneOfACellAndTheRestAsItIs) {
  const Places places = with_pile(6.0, 400.0, 0.5, 0.1);
  const PileLevel level{1.0, 6.0};
  const auto surplus = surplus_in_piles(places, level, {});
  std::map<std::tuple<double, double, double>, std::size_t> staying;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double angle = std::atan2(places[i].y() - kMiddle.y(), places[i].x() - kMiddle.x());
    const double beside = std::abs(angle - 0.5);
    if (beside > 0.8) {
      EXPECT_FALSE(surplus[i]);
    }
    if (beside > 0.4 || surplus[i]) continue;
    const Eigen::Array3d cell = places[i].array().floor();
    const std::tuple key(cell.x(), cell.y(), cell.z());
    EXPECT_EQ(++staying[key], 1U);
  }
  EXPECT_GT(staying.size(), 30U);
}

/// Of one of a hundred points at random the spread would be that of all.
TEST(PiledPoints, LeaveThoseThatLieOnTheSkinThatAllShow) {
  constexpr double kSigma = 0.2;
  const Places places = with_pile(6.0, 400.0, 0.5, kSigma);
  const auto surplus = surplus_in_piles(places, {1.0, 6.0}, {});
  double squares = 0.0;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double angle = std::atan2(places[i].y() - kMiddle.y(), places[i].x() - kMiddle.x());
    if (surplus[i] || std::abs(angle - 0.5) > 0.4) continue;
    sum += off_ring(places[i]);
    squares += std::pow(off_ring(places[i]), 2);
    ++count;
  }
  ASSERT_GT(count, 30U);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.25 * kSigma);
  EXPECT_NEAR(sum / static_cast<double>(count), 0.0, 0.1 * kSigma);
}

TEST(PiledPoints, LeaveThoseOfWhichTheLeastNoiseIsTold) {
  Places places = ring(6.0);
  const std::size_t quiet = places.size();
  RandomNumbers random(3);
  add(400.0, 0.5, 0.0, random, places);
  std::vector<double> doubts(places.size(), 1.0);
  std::fill(doubts.begin(), doubts.begin() + static_cast<std::ptrdiff_t>(quiet), 0.1);
  const auto surplus = surplus_in_piles(places, {1.0, 6.0}, doubts);
  std::size_t precise = 0;
  std::size_t rough = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double angle = std::atan2(places[i].y() - kMiddle.y(), places[i].x() - kMiddle.x());
    if (!surplus[i] && std::abs(angle - 0.5) < 0.4) ++(i < quiet ? precise : rough);
  }
  EXPECT_GT(precise, 10U * rough);
}

}  // namespace
}  // namespace instep
