#include "core/stride.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace instep {
namespace {

using Items = std::vector<int>;

TEST(OneIn, TakesTheFirstAndEachThatIsAStrideFurther) {
  EXPECT_EQ(one_in(3, Items{0, 1, 2, 3, 4, 5, 6}), (Items{0, 3, 6}));
  EXPECT_EQ(one_in(3, Items{0, 1, 2, 3, 4, 5}), (Items{0, 3}));
  EXPECT_EQ(one_in(1, Items{4, 5}), (Items{4, 5}));
  EXPECT_TRUE(one_in(2, Items{}).empty());
}

TEST(OneIn, TakesAtMostOrAtLeastAsManyAsTheStrideWasMadeFor) {
  for (std::size_t count = 1; count < 40; ++count) {
    const Items items(count, 0);
    const auto at_most = one_in(stride_to_at_most(7, count), items).size();
    EXPECT_LE(at_most, 7U);
    EXPECT_GT(2 * at_most, std::min<std::size_t>(7, count));
    EXPECT_GE(one_in(stride_to_at_least(7, count), items).size(), std::min<std::size_t>(7, count));
  }
}

}  // namespace
}  // namespace instep
