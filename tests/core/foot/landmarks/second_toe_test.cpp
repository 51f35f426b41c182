#include "core/foot/landmarks/second_toe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;

constexpr double kLengthMm = 246.0;

/// A toe seen from above: a rod along the foot with a ball for its tip.
struct Toe {
  Vector2d middle;  ///< of the ball
  double radius = 0.0;
};

constexpr std::size_t kSecond = 1;
const std::array<Toe, 5> kToes{{{{235, 24}, 10.5},
                                {{236, 5}, 6.5},
                                {{229, -10.5}, 6.2},
                                {{216, -25}, 6.2},
                                {{200, -39}, 6.5}}};

/// The skin of the toes and of a foot behind them, seen from above, a point for so many square
/// millimetres; noise lies along the skin's normal.
std::vector<Vector2d> outline(double area_mm2, double noise_mm, std::uint64_t seed) {
  constexpr double kRodMm = 40.0;
  test::RandomNumbers random(seed);
  std::vector<Vector2d> points;
  for (const Toe& toe : kToes) {
    const double area = 2.0 * std::numbers::pi * toe.radius * (kRodMm + toe.radius);
    for (int i = 0; i < area / area_mm2; ++i) {
      // Archimedes: a ball's skin holds as much of each slice as a rod's.
      const double ahead = random.uniform(-kRodMm, toe.radius);
      const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double rise = std::max(0.0, ahead / toe.radius);
      const double reach = toe.radius + noise_mm * random.normal();
      points.push_back(toe.middle +
                       Vector2d(ahead > 0.0 ? rise * reach : ahead,
                                std::sqrt(1.0 - rise * rise) * reach * std::cos(turn)));
    }
  }
  for (int i = 0; i < 200.0 * 90.0 / area_mm2; ++i) {
    const double x = random.uniform(0.0, 195.0);
    const double half = 44.0 - std::pow((x - 165.0) / 40.0, 2);
    points.emplace_back(x, half * std::cos(random.uniform(0.0, std::numbers::pi)) - 4.0);
  }
  return points;
}

TEST(SecondToe, IsNotToldOfAFootThatEndsAtTheBall) {
  auto points = outline(0.3, 0.0, 1);
  std::erase_if(points, [](const Vector2d& point) { return point.x() > 0.74 * kLengthMm; });
  EXPECT_FALSE(find_second_toe(points, kLengthMm));
}

TEST(SecondToe, IsToldWhereItsTipLies) {
  const auto toe = find_second_toe(outline(0.3, 0.0, 1), kLengthMm);
  ASSERT_TRUE(toe);
  EXPECT_TRUE(toe->is_resolved);
  EXPECT_NEAR(toe->tip.x(), kToes[kSecond].middle.x() + kToes[kSecond].radius, 0.7);
  EXPECT_NEAR(toe->tip.y(), kToes[kSecond].middle.y(), 0.7);
}

/// Strips without any point of the border looked like clefts. The tip is told to half of the
/// points' spacing.
TEST(SecondToe, IsToldInACoarseCloudWithNoise) {
  constexpr std::uint64_t kDraws = 40;
  constexpr double kAreaMm2 = 6.0;
  std::size_t told = 0;
  double squares = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const auto toe = find_second_toe(outline(kAreaMm2, 0.3, 100 + draw), kLengthMm);
    ASSERT_TRUE(toe);
    if (!toe->is_resolved) continue;
    ++told;
    squares += std::pow(toe->tip.y() - kToes[kSecond].middle.y(), 2);
  }
  EXPECT_GE(told, 36U);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(told)), 0.5 * std::sqrt(kAreaMm2));
}

TEST(SecondToe, IsPlacedByProportionWhereNoToesShow) {
  test::RandomNumbers random(3);
  for (int draw = 0; draw < 20; ++draw) {
    std::vector<Vector2d> sock;
    for (int i = 0; i < 4000; ++i) {
      const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
      const double radius = std::sqrt(random.uniform());
      const Vector2d noise(0.3 * random.normal(), 0.3 * random.normal());
      sock.push_back(Vector2d(0.5 * kLengthMm * (1.0 + radius * std::cos(turn)),
                              46.0 * radius * std::sin(turn)) +
                     noise);
    }
    const auto toe = find_second_toe(sock, kLengthMm);
    ASSERT_TRUE(toe);
    EXPECT_FALSE(toe->is_resolved) << draw;
  }
}

}  // namespace
}  // namespace instep
