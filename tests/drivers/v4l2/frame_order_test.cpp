#include "drivers/v4l2/frame_order.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

using std::chrono::microseconds;
using Time = FrameOrder::Time;

constexpr Time kBegin{1'000'000};

TEST(FrameOrder, KeepsTheDriversTimesWhenTheyAreSound) {
  FrameOrder order(kBegin);
  const auto first = order.place(0, Time(1'033'000), Time(1'040'000));
  const auto second = order.place(1, Time(1'066'000), Time(1'070'000));
  EXPECT_EQ(first.time, Time(1'033'000));
  EXPECT_EQ(second.time, Time(1'066'000));
  EXPECT_FALSE(first.stale || second.stale);
}

TEST(FrameOrder, ShowsLostFramesAsGapsOfTheSequence) {
  FrameOrder order(kBegin);
  const auto first = order.place(3, Time(1'033'000), Time(1'040'000));
  const auto next = order.place(6, Time(1'133'000), Time(1'140'000));
  EXPECT_EQ(next.sequence - first.sequence, 3U);
}

TEST(FrameOrder, GoesOnCountingWhenTheDriversNumbersEnd) {
  FrameOrder order(kBegin);
  const auto last = order.place(0xFFFFFFFF, Time(1'033'000), Time(1'040'000));
  const auto next = order.place(1, Time(1'099'000), Time(1'100'000));
  EXPECT_EQ(next.sequence, last.sequence + 2);
}

// Stamps on another clock than the buffer's flag promises, such as the camera's own.
TEST(FrameOrder, TakesTheTimeOfReceiptWhereThereIsNoMonotonicStamp) {
  FrameOrder order(kBegin);
  EXPECT_EQ(order.place(0, std::nullopt, Time(1'040'000)).time, Time(1'040'000));
  EXPECT_EQ(order.place(1, Time(0), Time(1'070'000)).time, Time(1'070'000));
}

// A time in the future cannot be of this clock.
TEST(FrameOrder, DoesNotBelieveAClockThatIsAhead) {
  FrameOrder order(kBegin);
  EXPECT_EQ(order.place(0, Time(99'000'000'000), Time(1'040'000)).time, Time(1'040'000));
  EXPECT_EQ(order.place(1, Time(99'033'000'000), Time(1'070'000)).time, Time(1'070'000));
}

// Constant and backward stamps, seen with real drivers.
TEST(FrameOrder, TimesGoForwardWhateverIsStamped) {
  for (const int step_us : {0, -33'000, 33'000}) {
    FrameOrder order(kBegin);
    Time last = Time::min();
    for (int i = 0; i < 20; ++i) {
      const Time now = kBegin + Time(40'000 + 33'000 * i);
      const auto place =
          order.place(static_cast<std::uint32_t>(i), kBegin + Time(700'000 + step_us * i), now);
      EXPECT_GT(place.time, last) << "step " << step_us << ", frame " << i;
      last = place.time;
    }
  }
}

TEST(FrameOrder, TellsStaleBuffers) {
  FrameOrder order(kBegin);
  EXPECT_TRUE(order.place(41, Time(999'000), Time(1'001'000)).stale) << "from before the stream";
  EXPECT_FALSE(order.place(0, Time(1'033'000), Time(1'040'000)).stale);
  EXPECT_TRUE(order.place(0, Time(1'033'000), Time(1'050'000)).stale) << "the same one again";
  EXPECT_FALSE(order.place(1, Time(1'066'000), Time(1'070'000)).stale);
}

// A driver that stamps one time for ever would otherwise never give a frame.
TEST(FrameOrder, UsesFramesOfAClockThatStandsBeforeTheStream) {
  FrameOrder order(kBegin);
  order.place(0, Time(500), Time(1'040'000));
  EXPECT_FALSE(order.place(1, Time(500), Time(1'070'000)).stale);
}

TEST(FrameOrder, CountsOnWhenTheDriverDoesNotCount) {
  FrameOrder order(kBegin);
  const auto first = order.place(0, Time(1'033'000), Time(1'040'000));
  const auto second = order.place(0, Time(1'066'000), Time(1'070'000));
  EXPECT_FALSE(second.stale);
  EXPECT_EQ(second.sequence, first.sequence + 1);
}

}  // namespace
}  // namespace instep
