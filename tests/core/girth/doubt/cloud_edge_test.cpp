#include "core/girth/doubt/cloud_edge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/circle_contour.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/empty_band.h"

namespace instep {
namespace {

constexpr double kRadius = 0.35;
constexpr double kGrain = 0.005;
constexpr double kSigma = 0.004;
/// Of a length, by skin that is half a standard deviation off all round.
constexpr double kAllRound = 0.5 * kSigma * 2.0 * std::numbers::pi;

/// A point each degree at heights of whole grains, up to five above the plane, and below it down to
/// `grains_below` up to some degrees.
PlaneBand band_of(int grains_below, int degrees_below) {
  PlaneBand band = test::empty_band();
  for (int grains = -grains_below; grains <= 5; ++grains) {
    for (int degree = 0; degree < (grains < 0 ? degrees_below : 360); ++degree) {
      const double angle = degree * std::numbers::pi / 180.0;
      const Eigen::Vector3d outward(std::cos(angle), std::sin(angle), 0.0);
      const Eigen::Vector3d place = kRadius * outward + grains * kGrain * Eigen::Vector3d::UnitZ();
      band.points.push_back({place, outward, kSigma * kSigma});
      band.seen.push_back(true);
    }
  }
  band.grain = kGrain;
  band.sigma = kSigma;
  return band;
}

double doubt_of(const PlaneBand& band) {
  return doubt_of_edge(band, ContourIndex(test::circle_contour(kRadius, 360)));
}

TEST(CloudEdge, CountsWhereOneSideIsMissing) {
  EXPECT_EQ(doubt_of(band_of(5, 360)), 0.0);
  EXPECT_NEAR(doubt_of(band_of(5, 270)), kAllRound / 4, 0.02 * kAllRound);
  EXPECT_NEAR(doubt_of(band_of(5, 120)), kAllRound * 2 / 3, 0.02 * kAllRound);
  EXPECT_DOUBLE_EQ(doubt_of(band_of(0, 0)), kAllRound);
}

TEST(CloudEdge, CountsLessTheFurtherItIs) {
  EXPECT_NEAR(doubt_of(band_of(1, 360)), kAllRound * 9 / 16, 1e-9);
  EXPECT_NEAR(doubt_of(band_of(2, 360)), kAllRound / 4, 1e-9);
  EXPECT_NEAR(doubt_of(band_of(4, 360)), 0.0, 1e-9);
}

TEST(CloudEdge, LeavesExactPointsWithoutDoubt) {
  auto band = band_of(5, 120);
  band.sigma = 1e-9;
  EXPECT_EQ(doubt_of(band), 0.0);
}

/// Of ten girths at a plane that leans by 26 degrees and cuts a cylinder down to 22 mm below its
/// middle, where the cloud ends at `bottom`, how many are within their intervals, and these narrow.
int held_of_ten(std::size_t count, double bottom, double sigma_mm) {
  const auto shape = test::elliptic_cylinder(40, 40);
  const auto plane = test::oblique_plane();
  const double truth = test::true_girth(shape, plane);
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto cloud = test::random_points(shape, count, bottom, 40, sigma_mm, seed);
    const auto girth = girth_by_rbf(cloud, plane);
    if (!girth || *girth->contact_u95_mm > sigma_mm) continue;
    if (std::abs(girth->contact_mm - truth) <= *girth->contact_u95_mm) ++held;
  }
  return held;
}

/// Girths were 0.11 mm short, and half of the intervals held.
TEST(CloudEdge, IsKnownToTheGirth) {
  EXPECT_GE(held_of_ten(60000, -20.0, 0.3), 9);
}

/// Of thick noise patches reach further: an edge two millimetres away left 8 of 16 to hold.
TEST(CloudEdge, OfThickNoiseIsKnownFromFurther) {
  EXPECT_GE(held_of_ten(40000, -24.0, 1.0), 9);
}

}  // namespace
}  // namespace instep
