#include "core/girth/doubt/bends_between_points.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>

#include "tests/support/analytic_shapes.h"
#include "tests/support/prism_points.h"
#include "tests/support/traced_section.h"

namespace instep {
namespace {

constexpr int kPoints = 1000;

UnseenBends bends_of(const test::TracedSection& section) {
  return bends_between_points(ContourCourse(section.contour), section.surface, section.spacing);
}

double mean_share(const std::function<PointCloud(std::uint64_t seed)>& draw) {
  constexpr std::uint64_t kDraws = 5;
  double mean = 0.0;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const test::TracedSection section(draw(seed));
    mean += bends_of(section).contact_u95 / section.contour.length() / kDraws;
  }
  return mean;
}

/// Edges of 20 degrees, too blunt to be found, are rounded by some tenths of a millimetre; an
/// ellipse with the same axes turns as much from point to point, but evenly.
TEST(BendsBetweenPoints, AreThoseOfEdgesNotOfASmoothBody) {
  const auto corners = test::many_sided(18, 45.0, 32.0);
  const double edged =
      mean_share([&](std::uint64_t seed) { return test::prism_points(corners, kPoints, seed); });
  const double smooth = mean_share([](std::uint64_t seed) {
    return test::random_points(test::elliptic_cylinder(45, 32), kPoints, -25, 25, 0.0, seed);
  });
  EXPECT_GT(edged, 5e-4);
  EXPECT_LT(smooth, 1e-6);
}

TEST(BendsBetweenPoints, AreNoneWhereNoiseHidesThem) {
  const test::TracedSection section(
      test::prism_points(test::many_sided(18, 45.0, 32.0), kPoints, 1, 0.5));
  EXPECT_EQ(bends_of(section).contact_u95, 0.0);
}

/// A tape bridges what bends inwards.
TEST(BendsBetweenPoints, OfHollowsAreNoneOfATape) {
  const test::PrismCorners star = {{-40, -30}, {0, -22}, {40, -30}, {33, 0},
                                   {40, 30},   {0, 22},  {-40, 30}, {-33, 0}};
  const test::TracedSection section(test::prism_points(star, kPoints, 1));
  const auto bends = bends_of(section);
  EXPECT_LT(bends.stretched_u95, bends.contact_u95);
}

TEST(BendsBetweenPoints, AreTheSameWhereverTheContourBegins) {
  test::TracedSection section(test::prism_points(test::many_sided(18, 45.0, 32.0), kPoints, 1));
  const auto bends = bends_of(section);
  ASSERT_GT(bends.stretched_u95, 0.0);
  for (int i = 0; i < 20; ++i) {
    section.begin_later(7);
    EXPECT_NEAR(bends_of(section).stretched_u95, bends.stretched_u95, 1e-12) << i;
  }
}

}  // namespace
}  // namespace instep
