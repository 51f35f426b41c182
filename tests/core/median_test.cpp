#include "core/median.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace instep
