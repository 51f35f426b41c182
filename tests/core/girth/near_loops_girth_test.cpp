#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/prism_points.h"

namespace instep {
namespace {

constexpr double kRadius = 40.0;

bool warns(const Girth& girth, const std::string& words) {
  for (const auto& warning : girth.warnings) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

/// A round body with a fin, so thin that its points may close round it alone.
test::PrismCorners finned(double width, double height) {
  test::PrismCorners corners;
  const double half = std::asin(0.5 * width / kRadius);
  constexpr int kSides = 720;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = half + (2.0 * std::numbers::pi - 2.0 * half) * i / kSides;
    corners.emplace_back(kRadius * std::cos(turn), kRadius * std::sin(turn));
  }
  corners.emplace_back(kRadius + height, -0.5 * width);
  corners.emplace_back(kRadius + height, 0.5 * width);
  return corners;
}

/// A slab `gap` beside the round body, far longer than it is wide.
Result<Girth> girth_beside_slab(double gap) {
  auto cloud = test::prism_points(test::many_sided(720, kRadius, kRadius), 8000, 3);
  const double from = kRadius + gap;
  const auto slab = test::prism_points(
      {{from, -1.0}, {from + 20.0, -1.0}, {from + 20.0, 1.0}, {from, 1.0}}, 2400, 4);
  cloud.append(slab);
  return girth_by_rbf(cloud, *TapePlane::through({0, 0, 0}, {50, 0, 0}, {0, 50, 0}), {});
}

/// Truth: the fin's own corners.
TEST(NearLoops, OfAFinAreInTheInterval) {
  int told = 0;
  for (const double height : {10.0, 20.0}) {
    const auto corners = finned(2.0, height);
    const double contact = perimeter(corners);
    const double stretched = perimeter(convex_hull(corners));
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const auto cloud = test::prism_points(corners, 8000, seed, 0.2);
      const auto girth =
          girth_by_rbf(cloud, *TapePlane::through({0, 0, 0}, {50, 0, 0}, {0, 50, 0}), {});
      if (!girth || !warns(*girth, "may be part of the body")) continue;
      ++told;
      EXPECT_LE(std::abs(girth->stretched_mm - stretched), *girth->stretched_u95_mm) << seed;
      EXPECT_LE(std::abs(girth->contact_mm - contact), *girth->contact_u95_mm) << seed;
    }
  }
  EXPECT_GT(told, 0);
}

TEST(NearLoops, AreToldFromFarOnes) {
  const auto far = girth_beside_slab(30.0);
  ASSERT_TRUE(far) << far.error().line();
  EXPECT_NEAR(far->stretched_mm, 2.0 * std::numbers::pi * kRadius, 0.3);
  EXPECT_LT(*far->stretched_u95_mm, 1.0);
  EXPECT_FALSE(warns(*far, "may be part of the body"));
  const auto near = girth_beside_slab(3.0);
  if (!near) return;
  const bool is_wide = *near->stretched_u95_mm > 10.0;
  EXPECT_TRUE(is_wide || near->stretched_mm > 270.0);
}

}  // namespace
}  // namespace instep
