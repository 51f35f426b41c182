#include "core/geometry/disjoint_sets.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random_numbers.h"

namespace instep {
namespace {

using Numbers = std::vector<std::size_t>;

TEST(DisjointSets, AreOneEachAtFirst) {
  DisjointSets sets(3);
  EXPECT_EQ(sets.count(), 3U);
  EXPECT_EQ(sets.numbers(), Numbers({0, 1, 2}));
  EXPECT_TRUE(DisjointSets(0).numbers().empty());
}

TEST(DisjointSets, GoByTheirLeastMember) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.join(5, 4));
  EXPECT_TRUE(sets.join(4, 1));
  EXPECT_FALSE(sets.join(1, 5));
  EXPECT_EQ(sets.of(5), 1U);
  EXPECT_EQ(sets.count(), 4U);
  EXPECT_EQ(sets.numbers(), Numbers({0, 1, 2, 3, 1, 1}));
}

/// Every member told of every join.
TEST(DisjointSets, AreThoseOfRelabelling) {
  constexpr std::size_t kSize = 200;
  test::RandomNumbers random(3);
  DisjointSets sets(kSize);
  Numbers labels(kSize);
  for (std::size_t i = 0; i < kSize; ++i) labels[i] = i;
  for (int joins = 0; joins < 150; ++joins) {
    const auto one = random.below(kSize);
    const auto other = random.below(kSize);
    const auto from = labels[one];
    const auto to = labels[other];
    EXPECT_EQ(sets.join(one, other), from != to);
    for (auto& label : labels) {
      if (label == from) label = to;
    }
  }
  const auto numbers = sets.numbers();
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) {
      EXPECT_EQ(numbers[i] == numbers[j], labels[i] == labels[j]);
    }
  }
}

}  // namespace
}  // namespace instep
