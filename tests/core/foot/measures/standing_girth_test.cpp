#include "core/foot/measures/standing_girth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"

namespace instep {
namespace {

/// A circle of radius 40 whose lowest point is `dip` below the platform, as a girth.
Girth circle(double dip) {
  constexpr int kSides = 7200;
  Girth girth;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    girth.contour.emplace_back(40 * std::cos(angle), 40 * std::sin(angle) + 40 - dip);
  }
  girth.contact_mm = girth.stretched_mm = 80 * std::numbers::pi;
  return girth;
}

TapePlane upright() {
  return *TapePlane::through({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

TEST(StandingGirth, CutsWhatDipsBelowThePlatform) {
  const Girth standing = standing_girth(circle(0.5), upright());
  const double half_angle = std::acos(39.5 / 40.0);
  const double expected =
      40 * (2 * std::numbers::pi - 2 * half_angle) + 2 * 40 * std::sin(half_angle);
  EXPECT_NEAR(standing.stretched_mm, expected, 1e-4);
  EXPECT_NEAR(standing.contact_mm, expected, 1e-4);
  for (const auto& point : standing.contour) EXPECT_GE(upright().lift(point).z(), -1e-12);
}

TEST(StandingGirth, LeavesWhatStandsClearAsItIs) {
  const Girth standing = standing_girth(circle(-1.0), upright());
  EXPECT_EQ(standing.contour.size(), circle(-1.0).contour.size());
  EXPECT_DOUBLE_EQ(standing.stretched_mm, 80 * std::numbers::pi);
}

}  // namespace
}  // namespace instep
