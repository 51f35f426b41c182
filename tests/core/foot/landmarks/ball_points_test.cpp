#include "core/foot/landmarks/ball_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/outline_of_borders.h"

namespace instep {
namespace {

using test::Border;
using test::outline_with;

constexpr double kLength = kFullSizeMm;  // as the outline is seen, whatever its own

/// A border that reaches furthest, by a parabola, at `place`.
Border bulging(double place, double bend) {
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
    const auto outline = outline_with(bulging(0.712 * kLength, bend), bulging(0.60 * kLength, bend),
                                      kLength, 0.0, 1);
    const auto tibiale = find_metatarsale_tibiale(outline);
    ASSERT_TRUE(tibiale);
    const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
    ASSERT_TRUE(fibulare);
    EXPECT_NEAR(tibiale->position_mm.x(), weighed(0.712 * kLength, bend, 0.69 * kLength), 0.7);
    const double usual = std::min(0.63 * kLength, tibiale->position_mm.x() - 15.0);
    EXPECT_NEAR(fibulare->position_mm.x(), weighed(0.60 * kLength, bend, usual), 0.7);
    EXPECT_NEAR(fibulare->position_mm.y(),
                bulging(0.60 * kLength, bend)(fibulare->position_mm.x()) * -1.0, 0.1);
  }
}

TEST(BallPoints, SayWhereOnlyTheProportionPlacesThem) {
  const auto straight = [](double) { return 45.0; };
  const auto flat = find_metatarsale_tibiale(outline_with(straight, straight, kLength, 0.0, 2));
  ASSERT_TRUE(flat);
  EXPECT_TRUE(flat->is_placed_by_proportion());
  const auto round = bulging(0.68 * kLength, 0.02);
  const auto clear = find_metatarsale_tibiale(outline_with(round, round, kLength, 0.0, 2));
  ASSERT_TRUE(clear);
  EXPECT_FALSE(clear->is_placed_by_proportion());
}

TEST(BallPoints, DoNotJumpOnANearlyStraightBorder) {
  // The lateral border of some feet: hardly bent, and its furthest place near the end of the range.
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto outline = outline_with(bulging(0.688 * kLength, 0.02),
                                      bulging(0.62 * kLength, 0.004), kLength, 0.3, seed);
    const auto tibiale = find_metatarsale_tibiale(outline);
    ASSERT_TRUE(tibiale);
    const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
    ASSERT_TRUE(fibulare);
    EXPECT_NEAR(fibulare->position_mm.x(), weighed(0.62 * kLength, 0.004, 0.63 * kLength), 2.0)
        << seed;
  }
}

TEST(BallPoints, OfASmallChildAreThoseOfAGrownFootInProportion) {
  constexpr double kShare = 120.0 / kLength;
  const auto shrunk = [](const Border& border) {
    return [=](double x) { return kShare * border(x / kShare); };
  };
  const Border medial = bulging(0.72 * kLength, 0.02);
  const Border lateral = bulging(0.60 * kLength, 0.01);
  const auto grown = outline_with(medial, lateral, kLength, 0.0, 7);
  const auto child = outline_with(shrunk(medial), shrunk(lateral), 120.0, 0.0, 7);
  const auto tibiale_of = [](const FootOutline& outline) {
    return find_metatarsale_tibiale(outline).value();
  };
  const auto place_of = [](const FootOutline& outline, const Landmark& landmark) {
    return outline.in_foot_frame(landmark).position_mm.x();
  };
  const Landmark tibiale = tibiale_of(grown);
  const Landmark fibulare = find_metatarsale_fibulare(grown, tibiale).value();
  const Landmark own_tibiale = tibiale_of(child);
  const Landmark own_fibulare = find_metatarsale_fibulare(child, own_tibiale).value();
  EXPECT_NEAR(place_of(child, own_tibiale), kShare * place_of(grown, tibiale), 0.2);
  EXPECT_NEAR(place_of(child, own_fibulare), kShare * place_of(grown, fibulare), 0.3);
}

/// Of each coordinate.
Eigen::Vector3d deviation_of(const Landmark& point) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const auto& off : point.deviations_off_mm) squares += off.cwiseAbs2();
  return squares.cwiseSqrt();
}

TEST(BallPoints, WhoseLateralWallWasNotSeenKeepTheirDistance) {
  const auto is_seen = [](double x, bool is_medial) {
    return is_medial || std::abs(x - 0.63 * kLength) > 14.0;
  };
  const auto outline = outline_with(bulging(0.664 * kLength, 0.03), bulging(0.628 * kLength, 0.02),
                                    kLength, 0.2, 1, test::kPointsOfBorders, is_seen);
  const auto tibiale = find_metatarsale_tibiale(outline);
  ASSERT_TRUE(tibiale);
  const auto fibulare = find_metatarsale_fibulare(outline, *tibiale);
  ASSERT_TRUE(fibulare);
  EXPECT_EQ(fibulare->deviations_off_mm.size(), 2U);
  EXPECT_LE(fibulare->position_mm.x(), tibiale->position_mm.x() - 15.0 + 1e-9);
  EXPECT_NEAR(fibulare->position_mm.x(), tibiale->position_mm.x() - 15.0, 6.0);
  const double off = deviation_of(*fibulare).y();
  EXPECT_NEAR(fibulare->position_mm.y(), -45.0, 2.0 * off);
  EXPECT_LT(off, 2.0);
}

TEST(BallPoints, WhoseWallWasNotSeenAreNotAtTheEdgeOfWhatWas) {
  // As between two feet: the medial wall is a guess behind the ball's furthest place.
  const auto border = [](double x) {
    const double off = x / kLength - 0.69;
    return 45.0 + kLength * (0.16 * off - 1.2 * off * off - 14.0 * off * off * off);
  };
  const auto is_seen = [](double x, bool is_medial) { return !is_medial || x > 0.73 * kLength; };
  double truth = 0.6 * kLength;
  const auto weighed_reach = [&](double x) {
    return border(x) - 0.5 * kHandicapBend * std::pow(x - 0.69 * kLength, 2);
  };
  for (double x = truth; x < 0.8 * kLength; x += 0.01) {
    if (weighed_reach(x) > weighed_reach(truth)) truth = x;
  }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto tibiale =
        find_metatarsale_tibiale(outline_with(border, bulging(0.62 * kLength, 0.02), kLength, 0.3,
                                              seed, test::kPointsOfBorders, is_seen));
    ASSERT_TRUE(tibiale);
    const Eigen::Vector3d deviation = deviation_of(*tibiale);
    EXPECT_NEAR(tibiale->position_mm.x(), truth, 2.0 * deviation.x());
    EXPECT_NEAR(tibiale->position_mm.y(), border(truth), 2.0 * deviation.y());
    EXPECT_LT(deviation.x(), 3.0);
    EXPECT_LT(deviation.y(), 2.0);
    EXPECT_EQ(deviation.z(), 0.0);
  }
  const auto seen = find_metatarsale_tibiale(
      outline_with(border, bulging(0.62 * kLength, 0.02), kLength, 0.3, 1));
  ASSERT_TRUE(seen);
  EXPECT_TRUE(seen->deviations_off_mm.empty());
}

/// The breadth of what was seen is less than the foot's.
TEST(BallPoints, OfTheBreadthAreNoNarrowerThanThoseThatWereNotSeen) {
  const auto border = [](double x) { return 45.0 - 0.01 * std::pow(x - 0.69 * kLength, 2); };
  const auto is_seen = [](double x, bool is_medial) {
    return !is_medial || std::abs(x - 0.69 * kLength) > 0.06 * kLength;
  };
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto outline = outline_with(border, bulging(0.62 * kLength, 0.02), kLength, 0.2, seed,
                                      test::kPointsOfBorders, is_seen);
    const auto hidden = find_ball_medial(outline, *find_metatarsale_tibiale(outline));
    ASSERT_TRUE(hidden);
    const double off = deviation_of(*hidden).y();
    EXPECT_NEAR(hidden->position_mm.y(), 45.0, 2.0 * off);
    EXPECT_GT(off, 0.1);
    EXPECT_LT(off, 3.0);
    const auto seen = find_ball_lateral(
        outline, *find_metatarsale_fibulare(outline, *find_metatarsale_tibiale(outline)));
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->deviations_off_mm.empty());
  }
}

}  // namespace
}  // namespace instep
