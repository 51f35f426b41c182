#include "core/foot/landmarks/standing_heel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/foot/skin/stationary_reach.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::RandomNumbers;

constexpr double kLength = 260.0;
const Vector3d kInstep(130.0, 3.0, 66.0);

/// A heel turned about an upright axis. Its profile is an arc that touches the floor, and above it
/// a wider one that goes on from it without a corner. Places of the profile: how far before the
/// pternion, and how high.
struct TurnedHeel {
  double edge = 7.0;             ///< radius of the lower arc
  double wall = 42.0;            ///< radius of the upper arc
  double dip_deg = 15.0;         ///< of the normal, where the one becomes the other
  double deepest_normal = -1.0;  ///< what points further down is not seen; -1: all is
  double noise = 0.0;            ///< along the normal
  double density = 0.35;         ///< points on a square millimetre
  double axis = 30.0;            ///< so far before the pternion

  /// The normal, outwards, where one arc becomes the other.
  Vector2d seam() const {
    const double dip = dip_deg * std::numbers::pi / 180.0;
    return {-std::cos(dip), -std::sin(dip)};
  }
  Vector2d wall_middle() const { return {wall, edge - (wall - edge) * seam().y()}; }
  Vector2d edge_middle() const { return wall_middle() + (wall - edge) * seam(); }

  /// By its normal, outwards.
  Vector2d skin(const Vector2d& normal) const {
    return normal.y() < seam().y() ? Vector2d(edge_middle() + edge * normal)
                                   : Vector2d(wall_middle() + wall * normal);
  }

  /// The furthest place of an arc lies behind its middle.
  Vector3d furthest_from(const Vector3d& place) const {
    const Vector2d from(place.x(), place.z());
    const Vector2d by_edge = (edge_middle() - from).normalized();
    const bool is_on_edge = by_edge.y() < seam().y();
    const Vector2d at = skin(is_on_edge ? by_edge : Vector2d((wall_middle() - from).normalized()));
    return {at.x(), 0.0, at.y()};
  }

  std::vector<Vector3d> points(std::uint64_t seed) const {
    RandomNumbers random(seed);
    std::vector<Vector3d> points;
    constexpr double kHighestDip = 0.5;
    constexpr double kTurn = 0.9;
    constexpr double kStep = 0.002;
    for (double dip = -kHighestDip; dip < std::numbers::pi / 2.0; dip += kStep) {
      const Vector2d normal(-std::cos(dip), -std::sin(dip));
      if (normal.y() < deepest_normal) break;
      const double radius = normal.y() < seam().y() ? edge : wall;
      const double area = radius * kStep * 2.0 * kTurn * (axis - skin(normal).x());
      for (double due = density * area; due > random.uniform(); due -= 1.0) {
        const double turn = random.uniform(-kTurn, kTurn);
        const Vector2d at = skin(normal) + noise * random.normal() * normal;
        const double away = axis - at.x();
        points.emplace_back(axis - away * std::cos(turn), away * std::sin(turn), at.y());
      }
    }
    // The sole within the edge.
    const double around = axis - edge_middle().x();
    const double sole = deepest_normal > -1.0 ? 0.0 : density * kTurn * around * around;
    for (double i = 0.0; i < sole; i += 1.0) {
      const double away = around * std::sqrt(random.uniform());
      const double turn = random.uniform(-kTurn, kTurn);
      points.emplace_back(axis - away * std::cos(turn), away * std::sin(turn),
                          noise * random.normal());
    }
    return points;
  }
};

/// Off the true place of many heels, on the way down the skin.
struct Misses {
  double mean = 0.0;
  double root_mean_square = 0.0;
};

constexpr int kHeels = 40;

template <typename Finder>
Misses misses_of(const TurnedHeel& heel, const Finder& found) {
  const Vector3d truth = heel.furthest_from(kInstep);
  const Vector3d away = (truth - kInstep).cwiseProduct(Vector3d(1.0, 0.0, 1.0)).normalized();
  const Vector3d down(-away.z(), 0.0, away.x());
  Misses misses;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < kHeels; ++seed) {
    const std::optional<Vector3d> place = found(heel.points(seed));
    if (!place) throw std::runtime_error("no furthest place was found");
    const double off = down.dot(*place - truth);
    misses.mean += off / kHeels;
    squares += off * off / kHeels;
  }
  misses.root_mean_square = std::sqrt(squares);
  return misses;
}

std::optional<Vector3d> by_standing_heel(const std::vector<Vector3d>& points) {
  const auto found = furthest_of_standing_heel(points, kLength, kInstep);
  return found ? std::optional(found->place) : std::nullopt;
}

/// The edge begins at various heights, and the wall leans in by more or less there.
std::vector<TurnedHeel> heels() {
  return {TurnedHeel{7.0, 42.0, 15.0}, TurnedHeel{7.0, 32.0, 22.0}, TurnedHeel{9.0, 60.0, 15.0}};
}

TEST(StandingHeel, IsFurthestWhereItsArcsSay) {
  for (auto heel : heels()) {
    heel.density = 2.0;
    const auto misses = misses_of(heel, by_standing_heel);
    // An arc that leans in is not quite the edge that is fitted.
    EXPECT_LT(misses.root_mean_square, 0.45) << heel.edge << ", " << heel.wall;
  }
}

TEST(StandingHeel, IsToldUnderNoiseWhereAPatchTellsLess) {
  for (auto heel : heels()) {
    heel.noise = 0.4;
    const auto misses = misses_of(heel, by_standing_heel);
    EXPECT_LT(std::abs(misses.mean), 0.25) << heel.edge << ", " << heel.wall;
    EXPECT_LT(misses.root_mean_square, 0.45) << heel.edge << ", " << heel.wall;
    const Vector3d start = heel.furthest_from(kInstep);
    const auto by_patch = misses_of(heel, [&](const std::vector<Vector3d>& points) {
      return furthest_reach(points, kInstep, start, {10.0, 16.0});
    });
    EXPECT_LT(misses.root_mean_square, 0.7 * by_patch.root_mean_square)
        << heel.edge << ", " << heel.wall;
  }
}

/// What is seen ends about where the furthest place is.
TEST(StandingHeel, IsToldWithoutItsSole) {
  for (auto heel : heels()) {
    heel.deepest_normal = -0.5;
    heel.noise = 0.2;
    const auto misses = misses_of(heel, by_standing_heel);
    EXPECT_LT(misses.root_mean_square, 1.0) << heel.edge << ", " << heel.wall;
  }
}

TEST(StandingHeel, TellsWhatAnEdgeThatWasNotSeenLeavesOpen) {
  TurnedHeel heel = heels().front();
  heel.noise = 0.1;
  const auto seen = furthest_of_standing_heel(heel.points(1), kLength, kInstep);
  heel.deepest_normal = -0.2;
  const auto unseen = furthest_of_standing_heel(heel.points(1), kLength, kInstep);
  ASSERT_TRUE(seen && unseen);
  EXPECT_LT(seen->one_deviation_off_mm.norm(), 0.1);
  EXPECT_GT(unseen->one_deviation_off_mm.norm(), 0.5);
  EXPECT_LT(unseen->one_deviation_off_mm.norm(), 2.0);
  // Up the wall, which overhangs there.
  EXPECT_GT(unseen->one_deviation_off_mm.z(), 0.0);
  EXPECT_LT(unseen->one_deviation_off_mm.x(), 0.0);
}

TEST(StandingHeel, DoesNotMindStrays) {
  TurnedHeel heel = heels().front();
  heel.noise = 0.2;
  const auto misses = misses_of(heel, [](std::vector<Vector3d> points) {
    for (int i = 0; i < 15; ++i) points.emplace_back(-4.0, i - 7.0, 4.0 + 0.5 * i);
    return by_standing_heel(points);
  });
  EXPECT_LT(misses.root_mean_square, 0.5);
}

TEST(StandingHeel, IsNotFoundInPointsThatShowNone) {
  EXPECT_FALSE(by_standing_heel({}));
  // A wall that overhangs so far that it is furthest at its top.
  std::vector<Vector3d> wall;
  for (double up = 0.0; up < 30.0; up += 1.0) {
    for (double y = -16.0; y <= 16.0; y += 1.0) wall.emplace_back(24.0 - 0.9 * up, y, up);
  }
  EXPECT_FALSE(by_standing_heel(wall));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(by_standing_heel(std::vector<Vector3d>(100, Vector3d(nan, nan, nan))));
  // One place, and one upright line: they tell nothing of how the wall goes on beside them.
  std::vector<Vector3d> line;
  for (double up = 0.0; up < 25.0; up += 0.1) line.emplace_back(0.0, 0.0, up);
  EXPECT_FALSE(by_standing_heel(std::vector<Vector3d>(100, Vector3d(0.0, 0.0, 10.0))));
  EXPECT_FALSE(by_standing_heel(line));
}

TEST(StandingHeel, IsNotFoundInAFootOfNoLength) {
  const auto points = heels().front().points(1);
  EXPECT_TRUE(furthest_of_standing_heel(points, kLength, kInstep));
  for (const double length : {0.0, -kLength, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(furthest_of_standing_heel(points, length, kInstep)) << length;
  }
}

}  // namespace
}  // namespace instep
