#include "core/foot/skin/hidden_crest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const BorderView kFromAbove{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(), 0.0, 25.0};
constexpr double kPlace = 180.0;
const UsualBorder kUsual{
    kPlace, 22.0, kPlace - 20.0, kPlace + 20.0, {0.07, -0.017, -0.00125}, {0.08, 0.0096, 0.00037},
    0.018};

/// A border of third order round the usual place.
struct Curve {
  Vector3d derivatives;

  double reach(double x) const {
    const double u = x - kPlace;
    return 45.0 + derivatives.dot(Vector3d(u, u * u / 2.0, u * u * u / 6.0));
  }

  double weighed_crest() const {
    const auto weighed = [&](double x) {
      return reach(x) - 0.5 * kUsual.handicap_bend_per_mm * std::pow(x - kPlace, 2);
    };
    double best = kPlace - 16.0;
    for (double x = best; x < kPlace + 16.0; x += 0.01) {
      if (weighed(x) > weighed(best)) best = x;
    }
    return best;
  }

  /// Of a wall round in height.
  SkinBorder border(double noise_mm, std::uint64_t seed) const {
    test::RandomNumbers random(seed);
    std::vector<Vector3d> points;
    for (int i = 0; i < 6000; ++i) {
      const double x = random.uniform(kPlace - 40.0, kPlace + 40.0);
      const double angle = random.uniform(-0.5, 0.5) * std::numbers::pi;
      points.emplace_back(x, reach(x) - 12.0 * (1.0 - std::cos(angle)) + noise_mm * random.normal(),
                          12.0 * (1.0 + std::sin(angle)));
    }
    return SkinBorder(points, kFromAbove, 9.0);
  }
};

SkinBorder before(const SkinBorder& border, double to) {
  return border.where([&](const SkinBorder::Place& place) { return place.along <= to; });
}

SkinBorder behind(const SkinBorder& border, double from) {
  return border.where([&](const SkinBorder::Place& place) { return place.along >= from; });
}

double outwards(const HiddenCrest& crest) {
  return std::hypot(crest.deviations_off_mm[0].y(), crest.deviations_off_mm[1].y());
}

TEST(HiddenCrest, OfABorderThatWasSeenIsItsCrest) {
  const Curve curve{{0.15, -0.026, -0.0009}};
  const auto border = curve.border(0.2, 1);
  const auto crest = hidden_crest(border, border, kUsual);
  ASSERT_TRUE(crest);
  EXPECT_NEAR(crest->place.along, curve.weighed_crest(), 0.5);
  EXPECT_NEAR(crest->place.reach, curve.reach(curve.weighed_crest()), 0.3);
  EXPECT_NEAR(crest->place.across, 12.0, 1.0);
  EXPECT_GT(crest->told_share, 0.6);
  EXPECT_LT(outwards(*crest), 0.8);
}

/// Of errors, by the deviations that were told: how many are within 1.96, and their mean square.
struct Calibration {
  int all = 0;
  int held = 0;
  double squares = 0.0;

  void add(double error, double deviation) {
    ++all;
    held += std::abs(error) <= 1.96 * deviation;
    squares += std::pow(error / deviation, 2);
  }
};

/// Feet drawn as they are said to be: the deviations have to hold, in any direction.
TEST(HiddenCrest, HasDeviationsThatHold) {
  const Vector2d directions[] = {{1.0, 0.0}, {0.0, 1.0}, {0.6, 0.8}, {0.6, -0.8}, {0.25, 0.97}};
  for (const double edge : {-6.0, 6.0, 12.0}) {
    test::RandomNumbers random(7);
    Calibration found[std::size(directions)];
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      Curve curve{kUsual.derivatives};
      for (int i = 0; i < 3; ++i) curve.derivatives(i) += kUsual.spreads(i) * random.normal();
      const auto whole = curve.border(0.3, seed);
      const auto told = edge < 0.0 ? before(whole, kPlace + edge) : behind(whole, kPlace + edge);
      const auto crest = hidden_crest(told, told, kUsual);
      if (!crest) continue;
      const double truth = curve.weighed_crest();
      const Vector2d error(crest->place.along - truth, crest->place.reach - curve.reach(truth));
      for (std::size_t i = 0; i < std::size(directions); ++i) {
        found[i].add(directions[i].dot(error),
                     std::hypot(directions[i].dot(crest->deviations_off_mm[0]),
                                directions[i].dot(crest->deviations_off_mm[1])));
      }
    }
    for (std::size_t i = 0; i < std::size(directions); ++i) {
      SCOPED_TRACE(std::to_string(edge) + ", direction " + std::to_string(i));
      const double ratio = std::sqrt(found[i].squares / found[i].all);
      EXPECT_GE(found[i].all, 195);
      EXPECT_GE(found[i].held, 0.9 * found[i].all);
      EXPECT_GT(ratio, 0.4);
      EXPECT_LT(ratio, 1.2);
    }
  }
}

TEST(HiddenCrest, IsLessSureTheFurtherItIsFromWhatWasSeen) {
  const auto whole = Curve{kUsual.derivatives}.border(0.0, 3);
  const auto near = hidden_crest(behind(whole, kPlace + 4.0), whole, kUsual);
  const auto far = hidden_crest(behind(whole, kPlace + 14.0), whole, kUsual);
  const auto guessed = hidden_crest(behind(whole, kPlace + 60.0), whole, kUsual);
  ASSERT_TRUE(near && far && guessed);
  EXPECT_GT(near->told_share, far->told_share);
  EXPECT_LT(outwards(*near), outwards(*far));
  EXPECT_LT(guessed->told_share, 0.05);
  EXPECT_GT(outwards(*guessed), 2.5);
}

TEST(HiddenCrest, IsNoneWithoutASample) {
  const auto none = behind(Curve{kUsual.derivatives}.border(0.0, 4), kPlace + 60.0);
  EXPECT_FALSE(hidden_crest(none, none, kUsual));
}

TEST(HiddenCrest, IsAskedForWhereABorderHasAGap) {
  const auto whole = Curve{kUsual.derivatives}.border(0.0, 5);
  EXPECT_FALSE(has_gap(whole, kPlace - 30.0, kPlace + 30.0));
  EXPECT_TRUE(has_gap(before(whole, kPlace + 20.0), kPlace - 30.0, kPlace + 30.0));
  EXPECT_TRUE(has_gap(behind(whole, kPlace - 20.0), kPlace - 30.0, kPlace + 30.0));
  const auto holed = whole.where(
      [](const SkinBorder::Place& place) { return std::abs(place.along - kPlace) > 6.0; });
  EXPECT_TRUE(has_gap(holed, kPlace - 30.0, kPlace + 30.0));
  EXPECT_FALSE(has_gap(holed, kPlace + 8.0, kPlace + 30.0));
}

}  // namespace
}  // namespace instep
