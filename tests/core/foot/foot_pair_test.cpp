#include "core/foot/foot_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace instep {
namespace {

using testing::ElementsAre;

struct Value {
  const char* id;
  double value_mm;
  std::optional<double> u95_mm = {};
};

MeasureSet set_of(const std::vector<Value>& values) {
  MeasureSet set;
  for (const auto& [id, value_mm, u95_mm] : values) {
    Measure measure;
    measure.id = id;
    measure.value_mm = value_mm;
    measure.u95_mm = u95_mm;
    set.measures.push_back(measure);
  }
  return set;
}

TEST(FootPair, PutsTheMeasuresOfBothFeetSideBySide) {
  const auto pair =
      pair_feet(set_of({{"foot_length", 260.0}, {"ball_girth", 245.0, 0.3}, {"arch", 20.0}}),
                set_of({{"waist", 240.0}, {"ball_girth", 244.0, 0.4}, {"foot_length", 262.5}}));
  ASSERT_EQ(pair.measures.size(), 2U);
  EXPECT_EQ(pair.measures[0].id, "foot_length");
  EXPECT_EQ(pair.measures[0].difference_mm(), 2.5);
  EXPECT_FALSE(pair.measures[0].u95_mm);
  EXPECT_EQ(pair.measures[1].difference_mm(), -1.0);
  // Pythagoras: 3, 4, 5.
  EXPECT_DOUBLE_EQ(pair.measures[1].u95_mm.value(), 0.5);
  EXPECT_THAT(pair.of_one_foot, ElementsAre("arch", "waist"));
}

TEST(FootPair, TheLongerFootLeads) {
  const auto led = [](Value left, Value right) {
    return pair_feet(set_of({left}), set_of({right})).leading();
  };
  EXPECT_EQ(led({"foot_length", 260.0}, {"foot_length", 260.1}), Side::kRight);
  EXPECT_EQ(led({"foot_length", 260.1}, {"foot_length", 260.0}), Side::kLeft);
  EXPECT_FALSE(led({"foot_length", 260.0}, {"foot_length", 260.0}));
  EXPECT_FALSE(led({"ball_girth", 260.0}, {"ball_girth", 270.0}));
}

TEST(FootPair, DoesNotCallLargerWhatMayBeChance) {
  const auto larger = [](double right_mm) {
    return pair_feet(set_of({{"ball_girth", 240.0, 0.6}}), set_of({{"ball_girth", right_mm, 0.8}}))
        .find("ball_girth")
        ->larger();
  };
  EXPECT_FALSE(larger(240.9));
  EXPECT_FALSE(larger(239.1));
  EXPECT_EQ(larger(241.1), Side::kRight);
  EXPECT_EQ(larger(238.9), Side::kLeft);
}

TEST(FootPair, LeavesOutWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto pair = pair_feet(set_of({{"foot_length", nan}, {"ball_girth", 240.0}}),
                              set_of({{"foot_length", 260.0}, {"ball_girth", nan}}));
  EXPECT_TRUE(pair.measures.empty());
  EXPECT_THAT(pair.of_one_foot, ElementsAre("ball_girth", "foot_length"));
  EXPECT_FALSE(pair.leading());
}

}  // namespace
}  // namespace instep
