#include "core/foot/skin/border_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace instep {
namespace {

using Eigen::Vector2d;

/// A filled strip under a border y = f(x).
template <typename Border>
std::vector<Vector2d> body(const Border& border, double spacing) {
  std::vector<Vector2d> points;
  for (double x = 0.0; x <= 200.0; x += spacing) {
    for (double y = border(x); y > border(x) - 40.0; y -= spacing) points.emplace_back(x, y);
  }
  return points;
}

TEST(BorderProfile, FindsASummitUnderTheSpacing) {
  const auto border = [](double x) { return 40.0 - std::pow((x - 123.4) / 20.0, 2); };
  const BorderProfile profile(body(border, 1.0), Vector2d::UnitX(), Vector2d::UnitY(), 9.0);
  const auto peak = profile.furthest(90.0, 160.0);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->place, 123.4, 1.0);
  EXPECT_NEAR(peak->reach, 40.0, 0.05);
}

TEST(BorderProfile, IsFurthestAtTheEndOfARangeThatItRisesIn) {
  const BorderProfile profile(body([](double x) { return 30.0 + 0.1 * x; }, 1.0), Vector2d::UnitX(),
                              Vector2d::UnitY(), 9.0);
  EXPECT_NEAR(profile.furthest(50.0, 150.0)->place, 150.0, 0.5);
}

TEST(BorderProfile, IgnoresAStray) {
  auto points = body([](double) { return 30.0; }, 1.0);
  points.emplace_back(100.0, 60.0);
  const BorderProfile profile(points, Vector2d::UnitX(), Vector2d::UnitY(), 9.0);
  EXPECT_NEAR(*profile.reach(100.0), 30.0, 0.05);
}

/// Round tips 16 mm apart, of 6.5 mm radius; a gap of the points' own is no cleft, one between toes
/// is.
TEST(BorderProfile, LiftsSamplesThatFallShortOfABendTheBorderCanHave) {
  const auto toes = [](double x) {
    const double off = std::remainder(x - 8.0, 16.0);
    return 50.0 + std::sqrt(std::max(0.0, 6.5 * 6.5 - off * off));
  };
  auto points = body(toes, 0.5);
  const auto is_in_gap = [&](const Vector2d& point) {
    return std::abs(point.x() - 42.0) < 1.0 && point.y() > 47.0;
  };
  std::erase_if(points, is_in_gap);
  const auto summits = [&](double tightest_bend_mm) {
    const BorderProfile profile(points, Vector2d::UnitX(), Vector2d::UnitY(), 3.5, 1.0,
                                tightest_bend_mm);
    return profile.summits(16.0, 64.0, 1.0);
  };
  EXPECT_EQ(summits(0.0).size(), 4U);
  const auto lifted = summits(2.5);
  ASSERT_EQ(lifted.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(lifted[i].place, 24.0 + 16.0 * static_cast<double>(i), 0.6);
    EXPECT_NEAR(lifted[i].reach, 56.5, 0.3);
  }
}

TEST(BorderProfile, TellsSummitsOfToesApart) {
  const auto toes = [](double x) { return 10.0 + 4.0 * std::cos(x * 2.0 * 3.14159265 / 40.0); };
  const BorderProfile profile(body(toes, 0.7), Vector2d::UnitX(), Vector2d::UnitY(), 5.0);
  const auto summits = profile.summits(10.0, 190.0, 2.0);
  ASSERT_EQ(summits.size(), 4U);
  EXPECT_NEAR(summits[0].place, 40.0, 1.0);
  EXPECT_NEAR(summits[3].place, 160.0, 1.0);
}

TEST(BorderProfile, SaysNothingWhereThereAreNoPoints) {
  const BorderProfile profile(body([](double) { return 30.0; }, 1.0), Vector2d::UnitX(),
                              Vector2d::UnitY(), 9.0);
  EXPECT_FALSE(profile.reach(300.0));
  EXPECT_FALSE(profile.furthest(300.0, 350.0));
  const BorderProfile none({}, Vector2d::UnitX(), Vector2d::UnitY(), 9.0);
  EXPECT_FALSE(none.reach(0.0));
  EXPECT_TRUE(none.summits(0.0, 10.0, 1.0).empty());
}

}  // namespace
}  // namespace instep
