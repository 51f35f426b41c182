// Slots and fins narrower than the points are apart, which a surface through most of them passes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/geometry/polygon.h"
#include "core/girth/girth.h"
#include "tests/support/prism_points.h"

namespace instep {
namespace {

/// A round body with a slot, or with a fin of negative depth.
test::PrismCorners slotted(double width, double depth) {
  constexpr double kRadius = 40.0;
  constexpr int kSides = 720;
  test::PrismCorners corners;
  const double half = std::asin(0.5 * width / kRadius);
  for (int i = 0; i <= kSides; ++i) {
    const double turn = half + (2.0 * std::numbers::pi - 2.0 * half) * i / kSides;
    corners.emplace_back(kRadius * std::cos(turn), kRadius * std::sin(turn));
  }
  corners.emplace_back(kRadius - depth, -0.5 * width);
  corners.emplace_back(kRadius - depth, 0.5 * width);
  return corners;
}

struct Tally {
  int told = 0;
  int silently_wrong = 0;  ///< by over two intervals
};

/// Truth: the corners of the section.
Tally tally_of(const test::PrismCorners& corners, int count, double sigma) {
  const double contact = perimeter(corners);
  const double stretched = perimeter(convex_hull(corners));
  const auto plane = *TapePlane::through({0, 0, 0}, {50, 0, 0}, {0, 50, 0});
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto girth = girth_by_rbf(test::prism_points(corners, count, seed, sigma), plane, {});
    if (!girth) continue;
    ++tally.told;
    const bool is_wrong =
        std::abs(girth->contact_mm - contact) > 2.0 * *girth->contact_u95_mm ||
        std::abs(girth->stretched_mm - stretched) > 2.0 * *girth->stretched_u95_mm;
    if (is_wrong && girth->warnings.empty()) ++tally.silently_wrong;
  }
  return tally;
}

TEST(NarrowParts, OfSlotsAreNotPassedOverInSilence) {
  for (const double width : {1.0, 2.0, 3.0}) {
    const auto corners = slotted(width, 8.0);
    EXPECT_EQ(tally_of(corners, 4000, 0.0).silently_wrong, 0) << width;
    EXPECT_EQ(tally_of(corners, 4000, 0.2).silently_wrong, 0) << width;
  }
}

TEST(NarrowParts, OfFinsAreNotPassedOverInSilence) {
  const auto corners = slotted(1.0, -8.0);
  EXPECT_EQ(tally_of(corners, 4000, 0.0).silently_wrong, 0);
  EXPECT_EQ(tally_of(corners, 4000, 0.2).silently_wrong, 0);
}

TEST(NarrowParts, AreNoneOfEvenSkinNorOfWideGrooves) {
  const auto plane = *TapePlane::through({0, 0, 0}, {50, 0, 0}, {0, 50, 0});
  for (const auto& corners : {test::many_sided(720, 45.0, 30.0), slotted(20.0, 8.0)}) {
    for (const double sigma : {0.0, 0.2}) {
      const auto girth = girth_by_rbf(test::prism_points(corners, 8000, 7, sigma), plane, {});
      ASSERT_TRUE(girth) << girth.error().line();
      for (const auto& warning : girth->warnings) {
        EXPECT_EQ(warning.find("too narrow"), std::string::npos) << warning;
      }
    }
  }
}

}  // namespace
}  // namespace instep
