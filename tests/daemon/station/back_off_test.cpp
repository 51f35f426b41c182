#include "daemon/station/back_off.h"

#include <gtest/gtest.h>

#include <chrono>

namespace instep {
namespace {

using namespace std::chrono_literals;

TEST(BackOff, DoublesFromTheFirstToTheLongestAndBeginsAnew) {
  BackOff pauses(5s, 60s);
  for (const auto pause : {5s, 10s, 20s, 40s, 60s, 60s}) EXPECT_EQ(pauses.next(), pause);
  pauses.reset();
  EXPECT_EQ(pauses.next(), 5s);
  EXPECT_EQ(BackOff().next(), BackOff::kFirst);
}

}  // namespace
}  // namespace instep
