#include "daemon/station/frame_tally.h"

#include <gtest/gtest.h>

namespace instep {
namespace {

DepthFrame frame_with(std::size_t valid, std::uint64_t sequence = 0) {
  DepthFrame frame;
  frame.width = 50;
  frame.height = 40;
  frame.raw.assign(2000, 0);
  std::fill_n(frame.raw.begin(), valid, std::uint16_t{700});
  frame.sequence = sequence;
  return frame;
}

// After hours some cameras send frames without a depth.
TEST(FrameTally, CallsAFrameEmptyBelowAHundredthOfItsPixels) {
  FrameTally tally;
  EXPECT_EQ(tally.count(frame_with(0)), FrameFault::kEmpty);
  EXPECT_EQ(tally.count(frame_with(19)), FrameFault::kEmpty);
  EXPECT_EQ(tally.count(frame_with(20)), FrameFault::kNone);
  EXPECT_EQ(tally.counts().empty, 2U);
  EXPECT_EQ(tally.counts().good, 1U);
}

TEST(FrameTally, TellsTheFirstOfWhatIsWrong) {
  FrameTally tally;
  DepthFrame frame = frame_with(0);
  frame.raw.resize(1999);
  EXPECT_EQ(tally.count(frame), FrameFault::kShort);
  frame.status = FrameStatus::kIncomplete;
  EXPECT_EQ(tally.count(frame), FrameFault::kShort);
  frame.status = FrameStatus::kStale;
  EXPECT_EQ(tally.count(frame), FrameFault::kStale);
  frame.status = FrameStatus::kCorrupt;
  frame.raw.clear();
  EXPECT_EQ(tally.count(frame), FrameFault::kErrorFlagged);
  EXPECT_EQ(tally.counts().short_of_pixels, 2U);
  EXPECT_EQ(tally.counts().stale, 1U);
  EXPECT_EQ(tally.counts().error_flagged, 1U);
  EXPECT_EQ(tally.counts().empty, 0U);
  EXPECT_EQ(tally.counts().good, 0U);
}

TEST(FrameTally, CountsTheGapsOfAStreamAndNotThoseBetweenTwo) {
  FrameTally tally;
  tally.begin_stream();
  for (const std::uint64_t sequence : {7U, 8U, 11U, 11U, 9U, 12U}) {
    tally.count(frame_with(100, sequence));
  }
  EXPECT_EQ(tally.counts().lost, 2U) << "9 and 10; a number that comes again is no gap";
  tally.begin_stream();
  tally.count(frame_with(100, 1000));
  tally.count(frame_with(100, 1001));
  EXPECT_EQ(tally.counts().lost, 2U);
}

}  // namespace
}  // namespace instep
