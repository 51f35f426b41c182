#include "core/surface/ribbon/ribbon_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

constexpr double kLength = 2.5;
constexpr int kKnots = 42;

using Skin = std::function<double(double way, double off)>;

/// A wave round the line, fading and leaning off the plane.
double wavy(double way, double off) {
  const double angle = 2.0 * std::numbers::pi * way / kLength;
  return 0.02 * std::sin(2.0 * angle) * (1.0 - 0.5 * off * off) + 0.03 * off * std::cos(angle) +
         0.01 * off * off;
}

std::vector<RibbonPoint> drawn(const Skin& skin, int count, double sigma, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  std::vector<RibbonPoint> points;
  for (int i = 0; i < count; ++i) {
    const double way = random.uniform(0.0, kLength);
    const double off = random.uniform(-1.0, 1.0);
    points.push_back({way, off, skin(way, off) + sigma * random.normal(), 1.0});
  }
  return points;
}

double mean_height(const RibbonSpline& spline) {
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) sum += spline.at(kLength * i / 500).value / 500.0;
  return sum;
}

TEST(RibbonSpline, FollowsSmoothSkinThroughNoise) {
  const auto spline = RibbonSpline::through(drawn(wavy, 5000, 0.005, 1), kLength, kKnots);
  ASSERT_TRUE(spline);
  EXPECT_NEAR(spline->sigma(), 0.005, 0.0002);
  double squares = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double way = kLength * i / 200;
    squares += std::pow(spline->at(way).value - wavy(way, 0.0), 2) / 200.0;
  }
  EXPECT_LT(std::sqrt(squares), 0.1 * 0.005);
}

TEST(RibbonSpline, IsNearlyExactWithHardlyAnyNoise) {
  const auto spline = RibbonSpline::through(drawn(wavy, 5000, 1e-5, 1), kLength, kKnots);
  ASSERT_TRUE(spline);
  for (double way = 0.0; way < kLength; way += 0.11) {
    EXPECT_NEAR(spline->at(way).value, wavy(way, 0.0), 5e-5);
  }
}

TEST(RibbonSpline, TellsItsSlope) {
  const auto spline = RibbonSpline::through(drawn(wavy, 3000, 0.002, 4), kLength, kKnots);
  ASSERT_TRUE(spline);
  const double h = 1e-6;
  for (double way = 0.0; way < kLength; way += 0.23) {
    const double slope = (spline->at(way + h).value - spline->at(way - h).value) / (2.0 * h);
    EXPECT_NEAR(spline->at(way).slope, slope, 1e-6);
  }
}

/// Skin that bends off the plane more than a parabola does, alike all round, as an ellipsoid's:
/// each stretch by itself hides it in the noise, all of them together tell it.
TEST(RibbonSpline, KnowsWhatIsTheSameAllRound) {
  constexpr int kDraws = 30;
  const auto barrel = [](double way, double off) {
    const double wave = 0.003 * std::sin(4.0 * std::numbers::pi * way / kLength);
    return wave + 0.35 * (std::sqrt(1.0 - 0.116 * off * off) - 1.0);
  };
  double off = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const auto spline =
        RibbonSpline::through(drawn(barrel, 5000, 0.0008, 200 + draw), kLength, kKnots);
    ASSERT_TRUE(spline);
    off += mean_height(*spline) / kDraws;
  }
  // A parabola is 0.00005 off.
  EXPECT_NEAR(off, 0.0, 0.00002);
}

/// The variance it tells is that of what is seen over many draws.
TEST(RibbonSpline, KnowsTheVarianceOfASum) {
  constexpr int kDraws = 200;
  const std::vector<double> ways = {0.3, 0.9, 1.6, 2.2};
  const std::vector<double> shares = {1.0, 2.0, -0.5, 1.5};
  double squares = 0.0;
  double told = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto points = drawn(wavy, 1500, 0.01, 100 + static_cast<std::uint64_t>(draw));
    const auto spline = RibbonSpline::through(points, kLength, kKnots);
    ASSERT_TRUE(spline);
    double error = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      error += shares[i] * (spline->at(ways[i]).value - wavy(ways[i], 0.0));
    }
    squares += error * error / kDraws;
    told += spline->variance_of_sum(ways, shares) / kDraws;
  }
  EXPECT_GT(std::sqrt(squares / told), 0.75);
  EXPECT_LT(std::sqrt(squares / told), 1.25);
}

TEST(RibbonSpline, DoesNotMindStrays) {
  auto points = drawn(wavy, 3000, 0.003, 2);
  const auto clean = RibbonSpline::through(points, kLength, kKnots);
  for (std::size_t i = 0; i < points.size(); i += 20) points[i].height += 0.1;
  const auto strayed = RibbonSpline::through(points, kLength, kKnots);
  ASSERT_TRUE(clean && strayed);
  // A twentieth of them by 0.1 would lift a mean by 0.005.
  EXPECT_NEAR(mean_height(*strayed), mean_height(*clean), 0.0003);
}

TEST(RibbonSpline, BelievesCertainPoints) {
  auto points = drawn(wavy, 2000, 0.002, 3);
  const auto alone = RibbonSpline::through(points, kLength, kKnots);
  for (auto& point : drawn(wavy, 2000, 0.05, 9)) {
    point.certainty = std::pow(0.002 / 0.05, 2);
    points.push_back(point);
  }
  const auto together = RibbonSpline::through(points, kLength, kKnots);
  ASSERT_TRUE(alone && together);
  EXPECT_NEAR(together->sigma(), 0.002, 0.0002) << "of a point of certainty one";
  EXPECT_LT(together->variance_of_sum({1.0}, {1.0}), 1.2 * alone->variance_of_sum({1.0}, {1.0}));
}

TEST(RibbonSpline, KnowsEvenSkinFromUneven) {
  const auto uneven = [](double way, double) { return 0.05 * std::sin(40.0 * way); };
  const auto even = RibbonSpline::through(drawn(wavy, 3000, 0.004, 5), kLength, kKnots);
  const auto rough = RibbonSpline::through(drawn(uneven, 3000, 0.004, 5), kLength, kKnots);
  ASSERT_TRUE(even && rough);
  EXPECT_LT(even->bending(), 0.003);
  EXPECT_GT(rough->bending(), 0.05);
}

TEST(RibbonSpline, BridgesAGapAndSaysSo) {
  auto points = drawn(wavy, 3000, 0.003, 6);
  std::erase_if(points,
                [](const RibbonPoint& point) { return point.way > 1.0 && point.way < 1.3; });
  const auto spline = RibbonSpline::through(points, kLength, kKnots);
  ASSERT_TRUE(spline);
  EXPECT_NEAR(spline->at(1.15).value, wavy(1.15, 0.0), 0.004);
  EXPECT_GT(spline->variance_of_sum({1.15}, {1.0}), 4.0 * spline->variance_of_sum({2.0}, {1.0}));
}

TEST(RibbonSpline, IsNotMadeOfTooLittle) {
  EXPECT_FALSE(RibbonSpline::through({}, kLength, kKnots));
  EXPECT_FALSE(RibbonSpline::through(drawn(wavy, 20, 0.003, 6), kLength, kKnots));
  // Without any noise it cannot be weighed.
  const auto flat = [](double, double) { return 0.0; };
  EXPECT_FALSE(RibbonSpline::through(drawn(flat, 500, 0.0, 6), kLength, kKnots));
  auto broken = drawn(wavy, 500, 0.003, 6);
  broken[7].height = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(RibbonSpline::through(broken, kLength, kKnots));
}

TEST(RibbonSpline, ScalesWithTheUnit) {
  auto points = drawn(wavy, 1000, 0.003, 8);
  const auto spline = RibbonSpline::through(points, kLength, kKnots);
  for (auto& point : points) {
    point.way *= 1024.0;
    point.height *= 1024.0;
  }
  const auto large = RibbonSpline::through(points, 1024.0 * kLength, kKnots);
  ASSERT_TRUE(spline && large);
  for (const double way : {0.2, 1.1, 2.3}) {
    EXPECT_NEAR(large->at(1024.0 * way).value, 1024.0 * spline->at(way).value, 1e-9);
  }
}

}  // namespace
}  // namespace instep
