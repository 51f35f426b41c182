#include "core/geometry/piles/pile_level.h"

#include <gtest/gtest.h>

#include "tests/support/piled_ring.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using test::PiledRing;
using Places = std::vector<Eigen::Vector3d>;

constexpr double kLeastSide = 0.5;

std::optional<PileLevel> level_of(const Places& places) {
  return level_beside_piles(places, PiledRing::kHeight, kLeastSide);
}

std::optional<PileLevel> level_with_part(double density, double of_part, double half_angle,
                                         double sigma) {
  PiledRing ring(density);
  ring.add(of_part, half_angle, sigma);
  return level_of(ring.points());
}

double density_of(const PileLevel& level) {
  return level.usual / (level.side * level.side);
}

TEST(PileLevel, IsNoneOfASkinThatIsSeenEvenly) {
  for (const double density : {0.3, 3.0, 100.0}) {
    EXPECT_FALSE(level_of(PiledRing(density).points()));
  }
  EXPECT_FALSE(level_of({}));
  const Eigen::Vector2d middle = PiledRing::middle();
  EXPECT_FALSE(level_of(Places(50, {middle.x(), middle.y(), 0.0})));
}

TEST(PileLevel, IsThatOfTheRestWhetherItIsSparseOrThePartCoversHalf) {
  for (const double density : {0.3, 3.0, 40.0}) {
    for (const double half_angle : {0.05, 0.4, 1.6}) {
      const auto level = level_with_part(density, 80.0 * density, half_angle, 0.0);
      ASSERT_TRUE(level) << density << " " << half_angle;
      EXPECT_GT(density_of(*level), 0.5 * density);
      EXPECT_LT(density_of(*level), 2.0 * density);
      EXPECT_GE(level->side, kLeastSide);
      EXPECT_GE(level->usual, 0.999);
    }
  }
}

TEST(PileLevel, IsNoneAmidStrays) {
  PiledRing ring(200.0);
  test::RandomNumbers random(2);
  const std::size_t strays = ring.points().size() / 5;
  for (std::size_t i = 0; i < strays; ++i) {
    ring.points().emplace_back(3.0 + random.uniform(-14.0, 14.0),
                               -2.0 + random.uniform(-14.0, 14.0), random.uniform(-3.0, 3.0));
  }
  EXPECT_FALSE(level_of(ring.points()));
}

TEST(PileLevel, HasWiderCellsWherePilesAreThickWithNoise) {
  const auto thin = level_with_part(6.0, 400.0, 0.5, 0.05);
  const auto thick = level_with_part(6.0, 400.0, 0.5, 0.5);
  ASSERT_TRUE(thin && thick);
  EXPECT_EQ(thin->side, kLeastSide);
  EXPECT_GE(thick->side, 2.0 * kLeastSide);
  EXPECT_NEAR(density_of(*thick), density_of(*thin), 0.5);
}

/// Ten times as many points tell more of a skin, unless they are noisier than the rest or less.
TEST(PileLevel, IsToldOfFewerPointsWhereTheirNoiseIsAnother) {
  EXPECT_FALSE(level_with_part(6.0, 54.0, 0.5, 0.0));
  EXPECT_TRUE(level_with_part(6.0, 54.0, 0.5, 0.2));
  for (const double sigma : {0.02, 0.2}) {
    PiledRing ring(0.0);
    ring.add(6.0, 3.1416, 0.2);
    ring.add(54.0, 0.5, sigma);
    EXPECT_EQ(level_of(ring.points()).has_value(), sigma < 0.1) << sigma;
  }
}

}  // namespace
}  // namespace instep
