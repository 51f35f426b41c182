#include "core/some_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace instep {
namespace {

TEST(SomeOf, AreAllOfFew) {
  EXPECT_TRUE(some_of(0, 5).empty());
  EXPECT_EQ(some_of(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(some_of(3, 3), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(SomeOf, AreAscendingAndAlwaysTheSame) {
  const auto some = some_of(10000, 700);
  ASSERT_EQ(some.size(), 700U);
  EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
  EXPECT_EQ(std::adjacent_find(some.begin(), some.end()), some.end());
  EXPECT_LT(some.back(), 10000U);
  EXPECT_EQ(some_of(10000, 700), some);
}

/// Of a list in lines of 90 a fifth: a stride would take the same 18 columns of each.
TEST(SomeOf, AreOfAllColumns) {
  std::vector<int> times(90, 0);
  for (const std::size_t i : some_of(18000, 3600)) ++times[i % 90];
  EXPECT_GT(*std::min_element(times.begin(), times.end()), 15);
  EXPECT_LT(*std::max_element(times.begin(), times.end()), 70);
}

}  // namespace
}  // namespace instep
