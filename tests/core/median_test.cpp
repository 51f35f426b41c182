#include "core/median.h"

#include <gtest/gtest.h>

#include <vector>

namespace instep {
namespace {

TEST(Median, IsTheMiddleValueWhateverTheOrder) {
  EXPECT_EQ(median<int>({7, -3, 100}), 7);
  EXPECT_EQ(median<double>({2.5, 2.5, 2.5, 9.0, 1.0}), 2.5);
}

TEST(Median, OfAnEvenNumberIsTheHigherOfTheTwo) {
  EXPECT_EQ(median<int>({4, 1, 3, 2}), 3);
}

TEST(Median, OfNothingIsZero) {
  EXPECT_EQ(median<double>({}), 0.0);
}

TEST(Quantile, HasThatShareOfTheOthersBelowIt) {
  const std::vector<int> values{40, 10, 50, 20, 30};
  EXPECT_EQ(quantile(values, 0.0), 10);
  EXPECT_EQ(quantile(values, 0.25), 20);
  EXPECT_EQ(quantile(values, 0.6), 30);
  EXPECT_EQ(quantile(values, 1.0), 50);
  EXPECT_EQ(quantile<double>({}, 0.5), 0.0);
}

}  // namespace
}  // namespace instep
