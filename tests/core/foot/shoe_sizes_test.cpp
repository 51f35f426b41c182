#include "core/foot/shoe_sizes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/foot/standing/shoe_last.h"

namespace instep {
namespace {

using testing::HasSubstr;

SizedFoot foot(double length_mm, std::optional<double> girth_mm = {}) {
  return {length_mm, girth_mm, std::nullopt};
}

TEST(ShoeSizes, OfAPairSayWhatIsOfOneFootAlone) {
  EXPECT_TRUE(notes_of_one_foot(foot(262.0, 240.0), foot(268.0, 250.0)).empty());
  const SizedFoot without_length{std::nullopt, 250.0, 101.0};
  const auto notes = notes_of_one_foot(without_length, foot(262.0, 240.0));
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_THAT(notes[0], HasSubstr("by the length of the right foot alone"));
  EXPECT_THAT(notes[1], HasSubstr("by the breadth of the left foot alone"));
}

TEST(ShoeSizes, EuCountsTwoThirdsOfACentimetreOfLast) {
  // A last of 28 cm is 42 Paris points by their definition; with 15 mm of allowance it is made for
  // a foot of 265 mm.
  const auto sizes = shoe_sizes(foot(265.0));
  EXPECT_NEAR(sizes.eu->exact, 42.0, 1e-9);
  EXPECT_EQ(sizes.eu->marked, 42.0);
  SizeRules roomy;
  roomy.allowance_mm = 20.0;
  EXPECT_EQ(shoe_sizes(foot(260.0), roomy).eu->marked, 42.0);
}

TEST(ShoeSizes, UkAgreesWithAMakersFigure) {
  // Koleff: a man's UK 8 is made for a foot of 265 mm.
  EXPECT_EQ(shoe_sizes(foot(265.0)).uk->marked, 8.0);
  // One size is a third of an inch.
  EXPECT_EQ(shoe_sizes(foot(265.0 + 25.4 / 3.0)).uk->marked, 9.0);
}

TEST(ShoeSizes, UsFollowsBrannocksScale) {
  // A man's size 1 is a foot of 7 2/3 inches, and each size a third more; a woman's is one less.
  for (int size = 1; size <= 16; ++size) {
    const double length = 25.4 * (7.0 + 2.0 / 3.0 + (size - 1) / 3.0);
    const auto sizes = shoe_sizes(foot(length));
    EXPECT_NEAR(sizes.us_men->exact, size, 1e-9);
    EXPECT_NEAR(sizes.us_women->exact, size + 1, 1e-9);
  }
  // A brand's chart: 9.00 inches are US 5.
  EXPECT_EQ(shoe_sizes(foot(9.0 * 25.4)).us_men->marked, 5.0);
}

TEST(ShoeSizes, MondopointIsTheFootToFiveMillimetres) {
  EXPECT_EQ(shoe_sizes(foot(277.4)).mondopoint_mm, 275.0);
  EXPECT_EQ(shoe_sizes(foot(277.6)).mondopoint_mm, 280.0);
  EXPECT_EQ(shoe_sizes({260.0, 250.0, 98.6}).mondopoint_width_mm, 99.0);
  EXPECT_FALSE(shoe_sizes(foot(260.0)).mondopoint_width_mm);
}

enum class Table { kMen, kWomen };

struct JisCase {
  Table table;
  double length_mm;
  double girth_mm;
  const char* size;
};

class JisSizes : public testing::TestWithParam<JisCase> {};

// From public renderings of the tables. A class reaches from 3 mm below its middle to 2 mm above,
// in whole millimetres.
TEST_P(JisSizes, AreThoseOfTheStandardsTables) {
  const auto& [table, length_mm, girth_mm, size] = GetParam();
  const auto sizes = shoe_sizes(foot(length_mm, girth_mm));
  EXPECT_EQ((table == Table::kMen ? sizes.jis_men : sizes.jis_women).value_or("none"), size);
}

INSTANTIATE_TEST_SUITE_P(Women, JisSizes,
                         testing::Values(JisCase{Table::kWomen, 235, 207, "23.5 A"},
                                         JisCase{Table::kWomen, 235, 225, "23.5 D"},
                                         JisCase{Table::kWomen, 235, 249, "23.5 EEEE"},
                                         JisCase{Table::kWomen, 230, 228, "23.0 E"},
                                         JisCase{Table::kWomen, 230, 225, "23.0 E"},
                                         JisCase{Table::kWomen, 230, 230, "23.0 E"},
                                         JisCase{Table::kWomen, 230, 231, "23.0 EE"},
                                         JisCase{Table::kWomen, 233, 233, "23.5 E"}));

INSTANTIATE_TEST_SUITE_P(Men, JisSizes,
                         testing::Values(JisCase{Table::kMen, 235, 210, "23.5 A"},
                                         JisCase{Table::kMen, 235, 252, "23.5 EEEE"},
                                         JisCase{Table::kMen, 250, 219, "25.0 A"},
                                         JisCase{Table::kMen, 250, 249, "25.0 EE"},
                                         JisCase{Table::kMen, 250, 246, "25.0 EE"},
                                         JisCase{Table::kMen, 250, 251, "25.0 EE"},
                                         JisCase{Table::kMen, 250, 252, "25.0 EEE"},
                                         JisCase{Table::kMen, 260, 261, "26.0 EEE"},
                                         JisCase{Table::kMen, 262, 261, "26.0 EEE"},
                                         JisCase{Table::kMen, 200, 189, "20.0 A"}));

TEST(ShoeSizes, LeaveOutWhatAScaleDoesNotReach) {
  const auto child = shoe_sizes(foot(160.0, 150.0));
  EXPECT_EQ(child.mondopoint_mm, 160.0);
  EXPECT_FALSE(child.uk);
  EXPECT_FALSE(child.us_men);
  EXPECT_FALSE(child.jis_men);
  EXPECT_THAT(child.notes, testing::ElementsAre(HasSubstr("outside the tables")));
  const auto long_foot = shoe_sizes(foot(290.0, 260.0));
  EXPECT_TRUE(long_foot.jis_men);
  EXPECT_FALSE(long_foot.jis_women);
  EXPECT_FALSE(shoe_sizes(foot(250.0, 200.0)).jis_men);
  EXPECT_FALSE(shoe_sizes(foot(250.0, 300.0)).jis_men);
}

TEST(ShoeSizes, AreNoneWithoutTheLengthAndHaveNoWidthWithoutTheGirth) {
  const auto none = shoe_sizes({std::nullopt, 250.0, 100.0});
  EXPECT_FALSE(none.mondopoint_mm || none.eu || none.uk || none.us_men || none.us_women);
  EXPECT_FALSE(none.jis_men || none.jis_women);
  EXPECT_THAT(none.notes, testing::ElementsAre(HasSubstr("foot length is missing")));
  const auto narrow = shoe_sizes(foot(250.0));
  EXPECT_TRUE(narrow.eu);
  EXPECT_FALSE(narrow.jis_men);
  EXPECT_THAT(narrow.notes, testing::ElementsAre(HasSubstr("ball girth is missing")));
}

TEST(ShoeSizes, ComeFromTheMeasuresThatAreNumbers) {
  MeasureSet set;
  set.measures.resize(3);
  set.measures[0].id = "foot_length";
  set.measures[0].value_mm = 251.0;
  set.measures[1].id = "ball_girth";
  set.measures[1].value_mm = std::numeric_limits<double>::quiet_NaN();
  set.measures[2].id = "foot_breadth";
  set.measures[2].value_mm = -1.0;
  const auto found = sized_foot(set);
  EXPECT_EQ(found.length_mm, 251.0);
  EXPECT_FALSE(found.ball_girth_mm);
  EXPECT_FALSE(found.breadth_mm);
}

TEST(ShoeSizes, TakeTheLargerOfTwoFeetInEachMeasure) {
  const SizedFoot longer{262.0, 240.0, std::nullopt};
  const SizedFoot wider{259.0, 251.0, 99.0};
  for (const auto& both : {larger_of(longer, wider), larger_of(wider, longer)}) {
    EXPECT_EQ(both.length_mm, 262.0);
    EXPECT_EQ(both.ball_girth_mm, 251.0);
    EXPECT_EQ(both.breadth_mm, 99.0);
  }
}

SizeRules shop() {
  SizeRules rules;
  rules.shop_tables = {{"Walker",
                        {{"41", 262.0, std::nullopt},
                         {"42", 268.0, 250.0},
                         {"42 wide", 268.0, 265.0},
                         {"43", 275.0, 270.0}}}};
  return rules;
}

TEST(ShopTable, GivesTheFirstRowThatTakesTheFoot) {
  const auto size = [](double length, double girth) {
    return shoe_sizes(foot(length, girth), shop()).shop.at(0).size.value_or("none");
  };
  EXPECT_EQ(size(262.0, 300.0), "41");
  EXPECT_EQ(size(262.1, 250.0), "42");
  EXPECT_EQ(size(262.1, 250.1), "42 wide");
  EXPECT_EQ(size(262.1, 266.0), "43");
  EXPECT_EQ(size(262.1, 271.0), "none");
  EXPECT_EQ(size(275.1, 250.0), "none");
}

/// Of one foot and of the larger of two alike.
TEST(ShoeSizes, SayWhenTheMeasuresWereDefinedOtherwise) {
  FootScan scan;
  ASSERT_FALSE(is_shoe_last(scan));
  EXPECT_TRUE(shoe_sizes(scan, foot(265.0, 250.0)).notes.empty());
  scan.rules.ball_girth = BallGirthRule::kShortest;
  EXPECT_THAT(shoe_sizes(scan, foot(265.0, 250.0)).notes,
              testing::ElementsAre(HasSubstr("usual definitions")));
  EXPECT_EQ(shoe_sizes(scan, foot(265.0, 250.0)).eu->marked, 42.0);
}

TEST(ShopTable, SaysWhatItWentBy) {
  const auto by_length = shoe_sizes(foot(265.0), shop()).shop.at(0);
  EXPECT_EQ(by_length.table, "Walker");
  EXPECT_EQ(by_length.size, "42");
  EXPECT_THAT(by_length.note, HasSubstr("length alone"));
  EXPECT_THAT(shoe_sizes(foot(300.0), shop()).shop.at(0).note, HasSubstr("no size"));
  EXPECT_EQ(shoe_sizes(foot(260.0), shop()).shop.at(0).note, "");
}

/// A child's foot was told a man's smallest size, with no word.
TEST(ShopTable, SaysThatItsSmallestSizeMayBeTooLong) {
  const auto note = [](double length, const SizeRules& rules) {
    return shoe_sizes(foot(length, 250.0), rules).shop.at(0).note;
  };
  EXPECT_EQ(note(252.5, shop()), "") << "a usual step shorter";
  EXPECT_THAT(note(151.5, shop()), HasSubstr("it takes a foot 110.5 mm longer"));
  EXPECT_THAT(shoe_sizes(foot(151.5), shop()).shop.at(0).size.value_or(""), "41");
  SizeRules sandals;
  sandals.shop_tables = {{"Sandal", {{"S", 230.0, std::nullopt}, {"M", 260.0, std::nullopt}}}};
  EXPECT_EQ(note(201.0, sandals), "") << "the steps of this table are wide";
  EXPECT_THAT(note(199.0, sandals), HasSubstr("too long"));
  EXPECT_EQ(note(231.0, sandals), "");
}

}  // namespace
}  // namespace instep
