#include "core/foot/measures/useless_measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace instep {
namespace {

using testing::HasSubstr;
using testing::Not;

Measure girth_within(double u95_mm) {
  Measure girth;
  girth.value_mm = 240.0;
  girth.u95_mm = u95_mm;
  return girth;
}

FootScan sure_foot() {
  FootScan foot;
  foot.side = Side::kLeft;
  foot.side_confidence = 1.0;
  return foot;
}

/// An eighth of 240 mm is 30.
TEST(UselessMeasure, SaysLessThanTheLengthOfAFootDoes) {
  EXPECT_FALSE(why_useless(girth_within(29.9), sure_foot()));
  EXPECT_THAT(why_useless(girth_within(31.0), sure_foot()).value_or(""),
              HasSubstr("to no better than +-31 mm: scan again"));
}

/// Of perfect frames of one foot it told to scan again with more frames.
TEST(UselessMeasure, AlongTheMiddleOfAHeelIsBetterTakenAlongAnotherAxis) {
  FootScan foot = sure_foot();
  EXPECT_THAT(why_useless(girth_within(67.0), foot).value_or(""), Not(HasSubstr("another axis")));
  foot.rules.axis = AxisRule::kHeelCentre;
  EXPECT_THAT(why_useless(girth_within(67.0), foot).value_or(""),
              HasSubstr("measure along another axis"));
}

}  // namespace
}  // namespace instep
