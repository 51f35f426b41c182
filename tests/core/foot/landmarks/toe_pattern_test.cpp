#include "core/foot/landmarks/toe_pattern.h"

#include <gtest/gtest.h>

#include <vector>

namespace instep {
namespace {

double second(const std::vector<double>& shares) {
  const auto found = second_of_toes(shares, std::vector<bool>(shares.size(), true));
  return found ? shares.at(*found) : -1.0;
}

TEST(ToePattern, NamesTheSecondOfFiveToes) {
  EXPECT_EQ(second({0.25, 0.46, 0.62, 0.78, 0.93}), 0.46);
  EXPECT_EQ(second({0.93, 0.62, 0.46, 0.25, 0.78}), 0.46);
}

TEST(ToePattern, DoesNotNeedTheBigToe) {
  EXPECT_EQ(second({0.47, 0.63, 0.77, 0.93}), 0.47);
}

TEST(ToePattern, KnowsASplayedFoot) {
  // The lab's left foot seen from above, its axis laid through the big toe: the second tip from the
  // medial side is the second toe's, though the first lies nearer to where second toes usually do.
  EXPECT_EQ(second({0.409, 0.578, 0.700, 0.821, 0.926}), 0.578);
}

/// A foot with a bunion, whose toes all lie further from the border of its ball.
TEST(ToePattern, HeedsWhatIsKnownNotToBeTheSecond) {
  const std::vector<double> shares{0.44, 0.59, 0.74, 0.87};
  EXPECT_EQ(second(shares), 0.44);
  EXPECT_FALSE(second_of_toes(shares, {false, true, true, true})) << "0.59 may be the third";
  const std::vector<double> splayed{0.409, 0.578, 0.700, 0.821, 0.926};
  EXPECT_EQ(second_of_toes(splayed, {false, true, true, true, true}), 1U);
  EXPECT_FALSE(second_of_toes(splayed, std::vector<bool>(5, false)));
}

TEST(ToePattern, PassesOverATipThatIsNone) {
  EXPECT_EQ(second({0.47, 0.62, 0.70, 0.78, 0.93}), 0.47);
  EXPECT_EQ(second({0.415, 0.457, 0.609, 0.749, 0.908}), 0.457);
}

TEST(ToePattern, SaysNothingWhereTheSecondToeDoesNotShow) {
  EXPECT_LT(second({0.62, 0.78, 0.93}), 0.0);
  EXPECT_LT(second({0.25, 0.62, 0.78, 0.93}), 0.0);
}

/// A simulated foot whose second toe is 7.6 mm shorter than the big one, seen without noise: the
/// fourth tip is the big toe's side.
TEST(ToePattern, DoesNotTakeABigToeForAHiddenSecondOne) {
  EXPECT_LT(second({0.386, 0.622, 0.777, 0.926}), 0.0);
  EXPECT_LT(second({0.405, 0.652, 0.795, 0.908}), 0.0);
}

TEST(ToePattern, SaysNothingOfASock) {
  EXPECT_LT(second({}), 0.0);
  EXPECT_LT(second({0.46}), 0.0);
  EXPECT_LT(second({0.53, 0.65}), 0.0);
  // What noise made of the front of a foot in a sock.
  EXPECT_LT(second({0.319, 0.518, 0.555, 0.625, 0.670, 0.778}), 0.0);
  EXPECT_LT(second({0.502, 0.648, 0.673, 0.695}), 0.0);
  EXPECT_LT(second({0.511, 0.571, 0.635, 0.655, 0.741, 0.761, 0.782, 0.900}), 0.0);
}

TEST(ToePattern, GivesUpOnManyTips) {
  std::vector<double> many(200, 0.5);
  EXPECT_LT(second(many), 0.0);
}

}  // namespace
}  // namespace instep
