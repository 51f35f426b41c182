#include "drivers/openni2/frame_numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace instep {
namespace {

TEST(FrameNumbers, LeaveOutWhatWasLost) {
  FrameNumbers numbers;
  EXPECT_EQ(numbers.next(7), 0U);
  EXPECT_EQ(numbers.next(8), 1U);
  EXPECT_EQ(numbers.next(11), 4U);
  numbers.begin_stream();
  EXPECT_EQ(numbers.next(500), 5U) << "between two streams nothing is lost";
}

TEST(FrameNumbers, GrowWhateverTheSensorCounts) {
  constexpr auto kLast = std::numeric_limits<std::uint64_t>::max();
  FrameNumbers numbers;
  std::uint64_t before = numbers.next(1);
  for (int round = 0; round < 100; ++round) {
    for (const std::uint64_t wild : {kLast, std::uint64_t{1}, kLast - 1, kLast / 2, kLast}) {
      const auto number = numbers.next(wild);
      ASSERT_GT(number, before) << "after " << wild << " in round " << round;
      before = number;
    }
  }
}

}  // namespace
}  // namespace instep
