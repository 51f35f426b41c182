#include "core/girth/section/unseen_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/degree.h"
#include "core/girth/girth.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/empty_band.h"

namespace instep {
namespace {

constexpr double kRadius = 0.3;

/// Points on a circle, a degree apart from the one angle to the other, at a height over the plane.
void add_arc(int first, int last, double height, PlaneBand& band) {
  for (int degree = first; degree <= last; ++degree) {
    const Eigen::Vector3d place(kRadius * std::cos(degree * kDegree),
                                kRadius * std::sin(degree * kDegree), height);
    band.points.push_back({place, place.normalized(), 0.0});
  }
}

PlaneBand band_of_grain(double grain) {
  PlaneBand band = test::empty_band();
  band.grain = grain;
  return band;
}

TEST(UnseenSide, IsOneStepOfAWholeCircle) {
  PlaneBand band = band_of_grain(0.01);
  add_arc(0, 359, 0.0, band);
  const auto side = widest_unseen_side(band);
  EXPECT_NEAR(side.angle, kDegree, 1e-9);
  EXPECT_NEAR(side.across, 2.0 * kRadius * std::sin(0.5 * kDegree), 1e-9);
}

/// The middle of what is there lies away from what is missing, which looks narrower from it.
TEST(UnseenSide, IsWhereAnArcIsMissingWhereverThatIs) {
  for (const int first : {-300, -170, -45, 0, 100, 179}) {
    PlaneBand band = band_of_grain(0.01);
    add_arc(first + 70, first + 360, 0.0, band);
    const auto side = widest_unseen_side(band);
    EXPECT_NEAR(side.across, 2.0 * kRadius * std::sin(35 * kDegree), 1e-9) << first;
    EXPECT_LT(side.angle, 70 * kDegree) << first;
    EXPECT_GT(side.angle, 50 * kDegree) << first;
  }
}

TEST(UnseenSide, IsNotSeenByPointsFarFromThePlane) {
  PlaneBand band = band_of_grain(0.01);
  add_arc(0, 270, 0.0, band);
  add_arc(271, 359, 0.1, band);
  EXPECT_NEAR(widest_unseen_side(band).across, 2.0 * kRadius * std::sin(45 * kDegree), 1e-9);
}

TEST(UnseenSide, IsAllRoundWithoutPoints) {
  EXPECT_EQ(widest_unseen_side(band_of_grain(0.01)).angle, 2.0 * std::numbers::pi);
}

/// Of a cylinder of radius 40, 150 degrees of which no camera saw: 77 mm straight across.
TEST(UnseenSide, IsToldOfASectionThatDoesNotClose) {
  const PointCloud whole = test::cylinder(4000, 0.0);
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto& place = whole.positions[i];
    if (std::abs(std::atan2(place.y(), place.x())) > 75 * kDegree) seen.push_back(i);
  }
  const auto girth = girth_by_rbf(whole.subset(seen), test::level_plane());
  ASSERT_FALSE(girth);
  EXPECT_NE(girth.error().line().find("no points over some 7"), std::string::npos)
      << girth.error().line();
}

std::string refusal_of(const PlaneBand& band) {
  return does_not_close(band).value().line();
}

TEST(UnseenSide, IsNotToldWherePointsLieAllRound) {
  PlaneBand band = band_of_grain(0.01);
  add_arc(0, 359, 0.0, band);
  EXPECT_NE(refusal_of(band).find("points all round"), std::string::npos) << refusal_of(band);
}

/// Two neighbours beside its middle are more than half a right angle apart, as seen from there.
TEST(UnseenSide, IsNotToldOfTheEndsOfAThinBody) {
  PlaneBand band = band_of_grain(0.02);
  for (int i = -10; i <= 10; ++i) {
    for (const double side : {-0.01, 0.01}) {
      band.points.push_back({{0.02 * i, side, 0.0}, {0.0, side < 0.0 ? -1.0 : 1.0, 0.0}, 0.0});
    }
  }
  EXPECT_GT(widest_unseen_side(band).angle, 0.5);
  EXPECT_NE(refusal_of(band).find("points all round"), std::string::npos) << refusal_of(band);
}

}  // namespace
}  // namespace instep
