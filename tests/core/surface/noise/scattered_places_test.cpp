#include "core/surface/noise/scattered_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kRadius = 0.35;
constexpr double kHalfHeight = 0.05;
constexpr double kTurn = 2.0 * std::numbers::pi;

double angle_of(const Eigen::Vector3d& place) {
  return std::atan2(place.y(), place.x());
}

/// How far a body reaches from its axis, at an angle.
double round_body(double) {
  return kRadius;
}

/// Twelve facets: edges of 30 degrees.
double faceted(double angle) {
  constexpr double kFacet = kTurn / 12;
  return kRadius / std::cos(std::remainder(angle, kFacet));
}

/// A ramp of a tenth of the radius: two edges of 45 degrees.
double ramped(double angle) {
  return kRadius * (1.0 + std::clamp(angle, 0.0, 0.1));
}

/// A belt of a body with noise of `sigma` from angle zero on, over a share of the turn.
struct Belt {
  std::vector<Eigen::Vector3d> points;
  PointIndex index;
  std::vector<std::size_t> places;  ///< next to its middle, in order

  template <typename Reach>
  Belt(const Reach& reach, std::size_t count, double share, double sigma, std::uint64_t seed)
      : index({}) {
    test::RandomNumbers random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = kTurn * (random.uniform() - 0.5);
      const bool scattered = angle >= 0.0 && angle < share * kTurn;
      const double away = reach(angle) + (scattered ? sigma * random.normal() : 0.0);
      const double z = kHalfHeight * (2.0 * random.uniform() - 1.0);
      points.emplace_back(away * std::cos(angle), away * std::sin(angle), z);
    }
    index = PointIndex(points);
    const double spacing =
        std::sqrt(2.0 * kTurn * kRadius * kHalfHeight / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (std::abs(points[i].z()) < 1.5 * spacing) places.push_back(i);
    }
    std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return angle_of(points[a]) < angle_of(points[b]);
    });
  }

  std::vector<ScatteredPlace> scattered() const { return scattered_places(index, places, 0.0); }
};

TEST(ScatteredPlaces, AreFoundInAFiftiethOfAnExactCrowd) {
  constexpr double kSigma = 0.002;
  for (const double share : {0.02, 0.05, 0.2}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto known = Belt(round_body, 12000, share, kSigma, seed).scattered();
      ASSERT_FALSE(known.empty()) << share << " " << seed;
      EXPECT_GT(most_scatter(known), 0.5 * kSigma) << share << " " << seed;
      int inner = 0;
      int told = 0;
      for (const auto& one : known) {
        // Of places next to the end a part of the points round them scatters.
        const double off = std::remainder(angle_of(one.place) - 0.5 * share * kTurn, kTurn);
        const double inside = 0.5 * share * kTurn - std::abs(off);
        if (inside > 0.1) {
          ++inner;
          if (std::abs(one.sigma - kSigma) < 0.5 * kSigma) ++told;
        } else if (inside < -0.1) {
          EXPECT_EQ(one.sigma, 0.0) << share << " " << seed;
        }
      }
      EXPECT_GE(told, 0.8 * inner) << share << " " << seed;
    }
  }
}

TEST(ScatteredPlaces, AreNeitherFacetsNorRamps) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const std::size_t count : {4000U, 12000U, 40000U}) {
      EXPECT_TRUE(Belt(round_body, count, 0.0, 0.0, seed).scattered().empty()) << count;
      EXPECT_TRUE(Belt(faceted, count, 0.0, 0.0, seed).scattered().empty()) << count;
      EXPECT_TRUE(Belt(ramped, count, 0.0, 0.0, seed).scattered().empty()) << count;
    }
  }
}

TEST(ScatteredPlaces, AreNotLookedForWherePointsLieWideApart) {
  EXPECT_TRUE(Belt(round_body, 800, 0.2, 0.01, 1).scattered().empty());
}

TEST(ScatteredPlaces, GiveAPointTheMoreOfTheTwoNearest) {
  const std::vector<ScatteredPlace> known = {{{0, 0, 0}, 0.0}, {{1, 0, 0}, 0.5}, {{2, 0, 0}, 0.2}};
  EXPECT_EQ(scatter_at(known, {0.1, 0, 0}), 0.5);
  EXPECT_EQ(scatter_at(known, {1.9, 0, 0}), 0.5);
  EXPECT_EQ(scatter_at({{{0, 0, 0}, 0.5}}, {0, 0, 0}), 0.0);
  EXPECT_EQ(most_scatter(known), 0.5);
  EXPECT_DOUBLE_EQ(mean_scatter(known), 0.7 / 3.0);
  EXPECT_EQ(mean_scatter({}), 0.0);
}

}  // namespace
}  // namespace instep
