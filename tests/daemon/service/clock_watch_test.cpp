#include "daemon/service/clock_watch.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using namespace std::chrono;

const ClockWatch::Reading kFirst{sys_days(2026y / 11 / 21), 100s};

ClockWatch::Reading after(nanoseconds by_the_clock, nanoseconds really) {
  return {kFirst.clock + duration_cast<system_clock::duration>(by_the_clock),
          kFirst.since_boot + really};
}

TEST(ClockWatch, TellsOfAClockSetByMuchAndOfNoOther) {
  EXPECT_FALSE(ClockWatch(kFirst).was_set(after(hours(24 * 400), hours(24 * 400))));
  EXPECT_FALSE(ClockWatch(kFirst).was_set(after(hours(24 * 3), 5s)));
  EXPECT_TRUE(ClockWatch(kFirst).was_set(after(hours(24 * 8), 5s)));
  EXPECT_TRUE(ClockWatch(kFirst).was_set(after(-hours(24 * 8), 5s)));
}

TEST(ClockWatch, StaysAtItOnceItWasSet) {
  ClockWatch watch(kFirst);
  EXPECT_TRUE(watch.was_set(after(hours(24 * 365 * 63), 5s)));
  EXPECT_TRUE(watch.was_set(after(10s, 10s)));
}

TEST(ClockWatch, ReadsTheMachine) {
  ClockWatch watch(ClockWatch::read());
  EXPECT_FALSE(watch.was_set(ClockWatch::read()));
}

}  // namespace
}  // namespace instep
