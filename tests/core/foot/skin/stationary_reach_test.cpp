#include "core/foot/skin/stationary_reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using test::RandomNumbers;

const Vector3d kAxis(120.0, 0.0, 60.0);
const Vector3d kAway = Vector3d(-0.9, 0.0, -std::sqrt(0.19));  // unit length
const Vector3d kDown(-kAway.z(), 0.0, kAway.x());
const Vector3d kFurthest = kAxis + 140.0 * kAway + Vector3d(0.0, 4.0, 0.0);
constexpr ReachPatch kPatch{12.0, 12.0};

/// A barrel about y that is furthest from the axis at kFurthest: seen from the side it is round,
/// with one radius above that place and another below.
std::vector<Vector3d> heel(double above, double below, double noise, std::uint64_t seed,
                           std::size_t count = 1500) {
  RandomNumbers random(seed);
  std::vector<Vector3d> points;
  while (points.size() < count) {
    const double turn = random.uniform(-1.4, 1.4);
    const double aside = random.uniform(-25.0, 25.0);
    const double radius = turn > 0.0 ? below : above;
    const double reach = radius + noise * random.normal();
    points.push_back(kFurthest - radius * kAway + reach * std::cos(turn) * kAway +
                     reach * std::sin(turn) * kDown - aside * aside / 60.0 * kAway +
                     aside * Vector3d::UnitY());
  }
  return points;
}

TEST(StationaryReach, FindsTheFurthestPlaceOfARoundHeel) {
  const auto points = heel(28.0, 28.0, 0.0, 1);
  const Vector3d start = kFurthest + Vector3d(0.5, 2.0, 2.0);
  const auto found = furthest_reach(points, kAxis, start, kPatch);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - kFurthest).norm(), 0.15);
}

TEST(StationaryReach, FindsWhereTheRoundEdgeOfTheSoleBegins) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kHeels = 30;
  for (int seed = 0; seed < kHeels; ++seed) {
    const auto points = heel(28.0, 9.0, 0.25, static_cast<std::uint64_t>(seed));
    const auto found = furthest_reach(points, kAxis, kFurthest, kPatch);
    ASSERT_TRUE(found);
    const double off = kDown.dot(*found - kFurthest);
    sum += off / kHeels;
    squares += off * off / kHeels;
    EXPECT_NEAR(kAway.dot(*found - kFurthest), 0.0, 0.2);
  }
  EXPECT_LT(std::abs(sum), 0.5);
  EXPECT_LT(std::sqrt(squares), 0.7);
}

TEST(StationaryReach, DoesNotMindStrays) {
  auto points = heel(28.0, 9.0, 0.1, 3);
  for (int i = 0; i < 12; ++i) {
    points.push_back(kFurthest + 3.5 * kAway + (i - 6.0) * kDown + (i % 3) * Vector3d::UnitY());
  }
  const auto found = furthest_reach(points, kAxis, kFurthest, kPatch);
  ASSERT_TRUE(found);
  EXPECT_LT(std::abs(kDown.dot(*found - kFurthest)), 0.6);
}

TEST(StationaryReach, FindsTheNearestPlaceOfAnAnkle) {
  // A saddle: nearest on the way round, a ridge across.
  std::vector<Vector3d> points;
  const double nearest = 90.0;
  for (double turn = -0.5; turn <= 0.5; turn += 0.01) {
    for (double aside = -15.0; aside <= 15.0; aside += 1.0) {
      const double reach = nearest + 60.0 * turn * turn - aside * aside / 40.0;
      points.emplace_back(kAxis.x() + reach * std::cos(0.6 + turn), aside + 3.0,
                          kAxis.z() + reach * std::sin(0.6 + turn));
    }
  }
  const Vector3d truth =
      kAxis + nearest * Vector3d(std::cos(0.6), 0.0, std::sin(0.6)) + 3.0 * Vector3d::UnitY();
  const auto found = nearest_reach(points, kAxis, truth + Vector3d(-2.0, 1.0, 2.0), kPatch);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - truth).norm(), 0.05);
}

/// Skin round kAxis, whose distance from it bends by so much on the way round and across.
std::vector<Vector3d> bent(double around, double across) {
  std::vector<Vector3d> points;
  for (double turn = -0.3; turn <= 0.3; turn += 0.01) {
    for (double aside = -30.0; aside <= 30.0; aside += 1.0) {
      const double reach = 100.0 + around * turn * turn + across * aside * aside;
      points.push_back(kAxis + Vector3d(reach * std::cos(turn), aside, reach * std::sin(turn)));
    }
  }
  return points;
}

TEST(StationaryReach, TellsTheFurthestPlaceFromTheNearest) {
  const Vector3d start = kAxis + Vector3d(100.0, 1.0, 1.0);
  const auto hollow = bent(150.0, -0.02);
  EXPECT_TRUE(nearest_reach(hollow, kAxis, start, kPatch));
  EXPECT_FALSE(furthest_reach(hollow, kAxis, start, kPatch));
  const auto round = bent(-150.0, -0.02);
  EXPECT_FALSE(nearest_reach(round, kAxis, start, kPatch));
  EXPECT_TRUE(furthest_reach(round, kAxis, start, kPatch));
  EXPECT_FALSE(furthest_reach(bent(-150.0, 0.02), kAxis, start, kPatch));
}

TEST(StationaryReach, DoesNotWanderFurtherThanThePatchReaches) {
  const auto round = bent(-150.0, -0.01);
  const auto found = [&](double aside) {
    const Vector3d start = kAxis + Vector3d(100.0 - 0.01 * aside * aside, aside, 0.0);
    return furthest_reach(round, kAxis, start, kPatch);
  };
  ASSERT_TRUE(found(10.0));
  EXPECT_NEAR(found(10.0)->y(), 0.0, 0.1);
  EXPECT_FALSE(found(20.0));
}

TEST(StationaryReach, SaysNothingOverAPatchWithoutExtent) {
  const auto round = bent(-150.0, -0.01);
  const auto hollow = bent(150.0, -0.01);
  const Vector3d start = kAxis + Vector3d(100.0, 0.0, 0.0);
  for (const ReachPatch& patch : {ReachPatch{}, ReachPatch{12.0, 0.0}, ReachPatch{-12.0, 12.0}}) {
    EXPECT_FALSE(furthest_reach(round, kAxis, start, patch));
    EXPECT_FALSE(nearest_reach(hollow, kAxis, start, patch));
  }
  EXPECT_FALSE(furthest_reach(round, start, start, kPatch));
}

TEST(StationaryReach, SaysNothingWhereTheSkinIsNotStationary) {
  std::vector<Vector3d> slope;
  for (double turn = -0.3; turn <= 0.3; turn += 0.01) {
    for (double aside = -15.0; aside <= 15.0; aside += 1.0) {
      const double reach = 100.0 + 100.0 * turn;
      slope.emplace_back(reach * std::cos(turn), aside, reach * std::sin(turn));
    }
  }
  EXPECT_FALSE(nearest_reach(slope, Vector3d::Zero(), {100, 0, 0}, kPatch));
  EXPECT_FALSE(nearest_reach({}, kAxis, kFurthest, kPatch));
  EXPECT_FALSE(furthest_reach(slope, Vector3d::Zero(), {100, 0, 0}, kPatch));
}

}  // namespace
}  // namespace instep
