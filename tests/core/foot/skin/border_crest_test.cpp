#include "core/foot/skin/border_crest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cases/drawn_feet.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;

constexpr double kBendAlong = 0.02;
constexpr double kBendAcross = 0.08;
constexpr CrestPatch kPatch{12.0, 8.0};

BorderView from_above() {
  return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(), 0.0, 25.0};
}

/// A wall that reaches furthest at (x 100, z 12), in the frame of from_above().
std::vector<Vector3d> wall(std::size_t points, double noise_mm, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<Vector3d> wall;
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.uniform(60.0, 140.0);
    const double z = random.uniform(0.0, 25.0);
    const double fall = kBendAlong * std::pow(x - 100.0, 2) + kBendAcross * std::pow(z - 12.0, 2);
    wall.emplace_back(x, 40.0 - 0.5 * fall + noise_mm * random.normal(), z);
  }
  return wall;
}

SkinBorder::Place start() {
  return {96.0, 39.5, 15.0, 0.0};
}

TEST(BorderCrest, IsWhereAParabolicWallReachesFurthest) {
  const auto crest = crest_near(wall(2000, 0.0, 1), from_above(), start(), kPatch);
  ASSERT_TRUE(crest);
  EXPECT_NEAR(crest->along, 100.0, 0.02);
  EXPECT_NEAR(crest->across, 12.0, 0.02);
  EXPECT_NEAR(crest->reach, 40.0, 1e-3);
  EXPECT_NEAR(crest->bend, -kBendAlong, 1e-6);
}

/// By 0.4 mm where a border that bends more and more is taken for one that bends evenly.
TEST(BorderCrest, IsNotPulledAsideWhereTheBorderBendsMoreAndMore) {
  constexpr double kMoreBend = 0.001;  // for each millimetre
  for (const double sign : {1.0, -1.0}) {
    auto points = wall(2000, 0.0, 3);
    for (auto& point : points) point.y() += sign * kMoreBend * std::pow(point.x() - 100.0, 3) / 6.0;
    const auto crest = crest_near(points, from_above(), start(), kPatch);
    ASSERT_TRUE(crest) << sign;
    EXPECT_NEAR(crest->along, 100.0, 0.02) << sign;
    EXPECT_NEAR(crest->reach, 40.0, 1e-3) << sign;
  }
}

/// Of two parabolas, the wall's and that of the usual place, each has its say by its bend.
TEST(BorderCrest, IsDrawnToItsUsualPlace) {
  const UsualPlace usual{112.0, 10.0};
  const double pull = 2.0 / (usual.spread_mm * usual.spread_mm);
  const auto crest = crest_near(wall(2000, 0.0, 2), from_above(), start(), kPatch, usual);
  ASSERT_TRUE(crest);
  EXPECT_NEAR(crest->along, (kBendAlong * 100.0 + pull * 112.0) / (kBendAlong + pull), 0.02);
  EXPECT_NEAR(crest->bend, -kBendAlong, 1e-6);
}

/// The scatter of the crest over draws of noise, against that of the smoothed border's furthest
/// place over as long a stretch.
TEST(BorderCrest, WandersLessThanTheFurthestOfASmoothedBorder) {
  constexpr std::uint64_t kDraws = 40;
  double of_crest = 0.0;
  double of_border = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const auto points = wall(1000, 0.5, 100 + draw);
    const auto crest = crest_near(points, from_above(), start(), kPatch);
    const SkinBorder border(points, from_above(), kPatch.along_mm);
    const auto furthest = border.furthest(80.0, 120.0);
    ASSERT_TRUE(crest && furthest) << draw;
    of_crest += std::pow(crest->along - 100.0, 2) / kDraws;
    of_border += std::pow(furthest->along - 100.0, 2) / kDraws;
  }
  EXPECT_LT(std::sqrt(of_crest), 0.6 * std::sqrt(of_border));
}

/// Found again from where it was found, a crest on a foot is where it was: a patch that points
/// enter and leave at its sides with their full weight goes to and fro.
TEST(BorderCrest, ComesToRestOnAFoot) {
  std::size_t found = 0;
  std::size_t restless = 0;
  for (const std::uint64_t seed : {301U, 309U, 315U}) {
    const auto drawn = test::draw_scanned_foot_without_truth(seed);
    const RigidTransform solid_from_input = drawn.input_from_solid.inverse();
    std::vector<Vector3d> points;
    for (const auto& point : drawn.cloud.positions) points.push_back(solid_from_input * point);
    for (const double side : {1.0, -1.0}) {
      const BorderView view{Vector3d::UnitX(), side * Vector3d::UnitY(), Vector3d::UnitZ(), 0.0,
                            40.0};
      const SkinBorder border(points, view, 9.0);
      for (double x = 60.0; x < 180.0; x += 2.0) {
        const auto place = border.at(x);
        if (!place) continue;
        const UsualPlace usual{x, 10.0};
        const auto crest = crest_near(points, view, *place, CrestPatch{11.0, 10.0}, usual);
        const auto again =
            crest ? crest_near(points, view, *crest, CrestPatch{11.0, 10.0}, usual) : std::nullopt;
        if (!again) continue;
        ++found;
        if (std::abs(again->along - crest->along) > 0.05) ++restless;
      }
    }
  }
  EXPECT_GT(found, 150U);
  EXPECT_LE(restless, found / 20);
}

/// What lies outside of the view may not have a say, even where it reaches further.
TEST(BorderCrest, LiesWithinTheViewWhereTheSkinReachesFurtherBeyond) {
  auto lower = wall(4000, 0.0, 7);
  for (auto& point : lower) point.z() -= 14.0;  // reaches furthest at z -2
  for (const double across : {3.0, -1.0, -3.5}) {
    const auto crest =
        crest_near(lower, from_above(), {97.0, 38.0, across, 0.0}, CrestPatch{12.0, 4.0});
    ASSERT_TRUE(crest) << across;
    EXPECT_NEAR(crest->across, 0.0, 1e-6);
    EXPECT_NEAR(crest->along, 100.0, 0.02);
    EXPECT_NEAR(crest->reach, 40.0 - 0.5 * kBendAcross * 4.0, 1e-3);
  }
  const SkinBorder::Place beside{97.0, 38.0, -4.5, 0.0};
  EXPECT_FALSE(crest_near(lower, from_above(), beside, CrestPatch{12.0, 4.0}));
}

/// Along a crest that slants, y(z) = 40 - a (x - 115)^2 / 2 - b (z - 24.5 - 1.5 (x - 96))^2 / 2,
/// the way leads out of the view; at its limit z = 25 the wall reaches furthest where both pull
/// alike.
TEST(BorderCrest, ComesToRestAtTheLimitThatASlantingCrestCrosses) {
  constexpr double kAlong = 0.005;
  constexpr double kSlant = 1.5;
  test::RandomNumbers random(8);
  std::vector<Vector3d> points;
  for (int i = 0; i < 8000; ++i) {
    const double x = random.uniform(60.0, 140.0);
    const double z = random.uniform(0.0, 60.0);
    const double off = z - 24.5 - kSlant * (x - 96.0);
    const double fall = kAlong * std::pow(x - 115.0, 2) + kBendAcross * off * off;
    points.emplace_back(x, 40.0 - 0.5 * fall, z);
  }
  const auto crest = crest_near(points, from_above(), {96.0, 39.0, 24.9, 0.0}, kPatch);
  ASSERT_TRUE(crest);
  const double pull = kBendAcross * kSlant;
  EXPECT_NEAR(crest->along, 96.0 + (kAlong * 19.0 + pull * 0.5) / (kAlong + pull * kSlant), 0.02);
  EXPECT_NEAR(crest->across, 25.0, 1e-6);
}

TEST(BorderCrest, IsNotMovedByStrays) {
  auto points = wall(2000, 0.1, 3);
  const auto without = crest_near(points, from_above(), start(), kPatch);
  for (int i = 0; i < 5; ++i) points.emplace_back(105.0 + 0.3 * i, 46.0, 10.0 + i);
  const auto with = crest_near(points, from_above(), start(), kPatch);
  ASSERT_TRUE(without && with);
  EXPECT_NEAR(with->along, without->along, 0.1);
}

TEST(BorderCrest, IsNoneWhereThePointsDoNotShowIt) {
  EXPECT_FALSE(crest_near({}, from_above(), start(), kPatch));
  EXPECT_FALSE(crest_near(wall(50, 0.0, 4), from_above(), start(), kPatch));
  auto half = wall(2000, 0.0, 5);
  std::erase_if(half, [](const Vector3d& point) { return point.x() > 95.0; });
  EXPECT_FALSE(crest_near(half, from_above(), start(), kPatch));
  auto valley = wall(2000, 0.0, 6);
  for (auto& point : valley) point.y() = 2.0 * 39.0 - point.y();
  EXPECT_FALSE(crest_near(valley, from_above(), start(), kPatch));
}

}  // namespace
}  // namespace instep
