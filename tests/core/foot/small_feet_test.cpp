#include "tests/support/cases/small_feet.h"

#include <gtest/gtest.h>

#include "tests/support/cases/drawn_feet.h"
#include "tests/support/cases/point_patterns.h"

namespace instep {
namespace {

/// With noise that does not shrink with them: what it hides of a small foot is in the intervals.
TEST(SmallDrawnFeet, AreMeasuredInProportion) {
  constexpr double kSigmaMm = 0.2;
  test::Proportion all;
  for (const std::uint64_t seed : {12U, 13U, 15U}) {
    const auto drawn = test::draw_scanned_foot_without_truth(seed);
    const auto grown = test::all_measures_of(drawn.cloud);
    ASSERT_TRUE(grown) << grown.error().line();
    const double length = grown->find("foot_length")->value_mm;
    for (const double child_mm : {125.0, 150.0, 180.0, 220.0}) {
      SCOPED_TRACE(drawn.making + ", at " + std::to_string(child_mm));
      const double share = child_mm / length;
      const auto cloud =
          test::with_isotropic_noise(test::scaled(drawn.cloud, share), kSigmaMm, seed);
      const auto child = test::all_measures_of(cloud);
      ASSERT_TRUE(child) << child.error().line();
      const auto proportion = test::proportion_of(*grown, *child, share);
      EXPECT_GE(proportion.measures, 15);
      EXPECT_LT(proportion.worst, 2.0);
      all.measures += proportion.measures;
      all.held += proportion.held;
    }
  }
  EXPECT_GE(all.held, 0.9 * all.measures);
}

}  // namespace
}  // namespace instep
