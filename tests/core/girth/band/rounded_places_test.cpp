#include "core/girth/band/rounded_places.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/girth/girth.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/cylinder_tape.h"
#include "tests/support/random_numbers.h"

namespace instep {
namespace {

const auto kBody = test::elliptic_cylinder(45, 30);

/// Of a body that stands anywhere on the steps.
Girth rounded_girth(double step_mm, double sigma_mm, std::uint64_t seed) {
  test::RandomNumbers random(seed);
  PointCloud cloud = test::random_points(kBody, 15000, -30, 30, sigma_mm, seed);
  const Eigen::Vector3d shift(random.uniform(0.0, step_mm), random.uniform(0.0, step_mm), 0.0);
  for (auto& place : cloud.positions) {
    place = step_mm * ((place + shift) / step_mm).array().round();
  }
  return girth_by_rbf(cloud, test::oblique_plane()).value();
}

/// Where the skin is level with an axis all points beside each other are rounded alike: intervals
/// that took that for noise of each were a third as wide as they had to be.
TEST(RoundedPlaces, LeaveOpenThatTheSkinMayLieHalfAStepFurtherOut) {
  const double truth = test::true_girth(kBody, test::oblique_plane());
  for (const double step_mm : {0.5, 1.0, 2.0}) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const Girth girth = rounded_girth(step_mm, 0.0, seed);
      held += std::abs(girth.stretched_mm - truth) <= *girth.stretched_u95_mm;
      EXPECT_LT(*girth.stretched_u95_mm, 0.7 * step_mm) << step_mm << " " << seed;
    }
    EXPECT_GE(held, 11) << step_mm;
  }
}

TEST(RoundedPlaces, AreAsGoodAsOthersWhereNoiseIsWiderThanTheSteps) {
  EXPECT_LT(*rounded_girth(0.5, 0.5, 1).stretched_u95_mm,
            1.2 * *rounded_girth(0.01, 0.5, 1).stretched_u95_mm);
}

}  // namespace
}  // namespace instep
