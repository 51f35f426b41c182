#include "core/geometry/piles/piled_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/piled_ring.h"

namespace instep {
namespace {

using test::PiledRing;
using Places = std::vector<Eigen::Vector3d>;

constexpr double kDensity = 6.0;
/// Of a part 70 times as dense.
constexpr double kHalfAngle = 0.5;
constexpr PileLevel kLevel{1.0, kDensity, 4.0};

Places with_part(double sigma) {
  PiledRing ring(kDensity);
  ring.add(70.0 * kDensity, kHalfAngle, sigma);
  return ring.points();
}

/// Well inside of the part.
bool is_in_part(const Eigen::Vector3d& place) {
  return PiledRing::beside(place) < 0.4 && std::abs(place.z()) < 2.5;
}

Places staying_in_part(const Places& places, const LevelledPoints& levelled) {
  Places staying;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!levelled.surplus[i] && is_in_part(places[i])) staying.push_back(places[i]);
  }
  return staying;
}

TEST(PiledPoints, LeaveNotMoreThanThereAreElsewhereAndTheRestAsItIs) {
  const Places places = with_part(0.1);
  const auto rest = levelled(places, kLevel, {});
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (PiledRing::beside(places[i]) > 0.8) {
      EXPECT_FALSE(rest.surplus[i]);
      EXPECT_EQ(rest.errors[i], 0.0);
    }
  }
  const double area = 2.0 * 0.4 * PiledRing::kRadius * 5.0;
  const auto staying = static_cast<double>(staying_in_part(places, rest).size());
  EXPECT_GT(staying, 0.3 * kDensity * area);
  EXPECT_LT(staying, kDensity * area);
}

/// What is left of their noise would be a steep slope between two of them.
TEST(PiledPoints, StayApart) {
  const Places places = with_part(0.2);
  const Places staying = staying_in_part(places, levelled(places, kLevel, {}));
  for (std::size_t i = 0; i < staying.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((staying[i] - staying[k]).norm(), 0.3);
  }
}

/// Of one of a hundred points at random the spread would be that of all.
TEST(PiledPoints, LieOnTheSkinThatAllShowToWithinTheirErrors) {
  for (const double sigma : {0.02, 0.1, 0.4}) {
    const Places places = with_part(sigma);
    const auto rest = levelled(places, kLevel, {});
    double squares = 0.0;
    double sum = 0.0;
    double count = 0.0;
    double most_error = 0.0;
    double worst = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (rest.surplus[i] || !is_in_part(places[i])) continue;
      if (!(rest.errors[i] > 0.0)) continue;
      const double off = PiledRing::off(places[i]);
      worst = std::max(worst, std::abs(off));
      most_error = std::max(most_error, rest.errors[i]);
      sum += off;
      squares += off * off;
      count += 1.0;
    }
    ASSERT_GT(count, 50.0);
    EXPECT_LT(std::sqrt(squares / count), 0.15 * sigma) << sigma;
    EXPECT_NEAR(sum / count, 0.0, 0.1 * sigma) << sigma;
    EXPECT_LT(worst, 2.0 * most_error) << sigma;
    EXPECT_LT(most_error, 0.6 * sigma) << sigma;
  }
}

/// A cell that the skin only passes beside holds what scatters furthest, and nothing else.
TEST(PiledPoints, AreNotThoseThatScatterFurthest) {
  const Places places = with_part(0.4);
  for (const auto& place : staying_in_part(places, levelled(places, kLevel, {}))) {
    EXPECT_LT(std::abs(PiledRing::off(place)), 0.4);
  }
}

TEST(PiledPoints, AreThoseOfWhichTheLeastNoiseIsTold) {
  PiledRing ring(kDensity);
  const std::size_t quiet = ring.points().size();
  ring.add(70.0 * kDensity, kHalfAngle, 0.0);
  const Places& places = ring.points();
  std::vector<double> doubts(places.size(), 1.0);
  std::fill(doubts.begin(), doubts.begin() + static_cast<std::ptrdiff_t>(quiet), 0.1);
  const auto rest = levelled(places, kLevel, doubts);
  std::size_t precise = 0;
  std::size_t rough = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!rest.surplus[i] && is_in_part(places[i])) ++(i < quiet ? precise : rough);
  }
  EXPECT_GT(precise, 2U * rough);
}

TEST(PiledPoints, LeaveTheMiddleOfAHeap) {
  PiledRing ring(kDensity);
  const Places skin = ring.points();
  const Eigen::Vector3d spot = skin.front();
  Places places = skin;
  test::RandomNumbers random(5);
  for (int i = 0; i < 3000; ++i) {
    places.push_back(spot +
                     0.05 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
  }
  const auto rest = levelled(places, kLevel, {});
  std::size_t staying = 0;
  for (std::size_t i = skin.size(); i < places.size(); ++i) {
    if (rest.surplus[i]) continue;
    ++staying;
    EXPECT_LT((places[i] - spot).norm(), 0.05);
  }
  EXPECT_LE(staying, 1U);
}

}  // namespace
}  // namespace instep
