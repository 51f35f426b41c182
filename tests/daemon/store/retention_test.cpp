#include "daemon/store/retention.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "daemon/scan/scan_id.h"
#include "tests/daemon/store/result_store_on_disk.h"

namespace instep {
namespace {

using test::ResultStoreOnDisk;
using testing::ElementsAre;

TEST_F(ResultStoreOnDisk, KeepsTheNewestOfTooMany) {
  for (const auto* id :
       {"20261101T000000000Z-aaaa", "20261102T000000000Z-aaaa", "20261103T000000000Z-aaaa"}) {
    put(id);
  }
  const auto now = *time_of_scan_id("20261104T000000000Z-aaaa");
  EXPECT_EQ(store.sweep({}, now).removed, 0U);
  EXPECT_EQ(store.sweep({.keep_days = 0, .keep_count = 2}, now).removed, 1U);
  EXPECT_THAT(*store.list(), ElementsAre("20261103T000000000Z-aaaa", "20261102T000000000Z-aaaa"));
}

TEST_F(ResultStoreOnDisk, RemovesWhatIsTooOld) {
  put("20261101T000000000Z-aaaa");
  put("20261103T000000000Z-aaaa");
  const auto now = *time_of_scan_id("20261104T120000000Z-aaaa");
  EXPECT_EQ(store.sweep({.keep_days = 2, .keep_count = 0}, now).removed, 1U);
  EXPECT_THAT(*store.list(), ElementsAre("20261103T000000000Z-aaaa"));
}

TEST_F(ResultStoreOnDisk, KeepsBothFeetOfAScanOrNone) {
  for (const auto* id : {"20261101T000000000Z-aaaa", "20261101T000000000Z-bbbb",
                         "20261102T000000000Z-aaaa", "20261102T000000000Z-bbbb"}) {
    put(id);
  }
  const auto now = *time_of_scan_id("20261104T000000000Z-aaaa");
  EXPECT_EQ(store.sweep({.keep_days = 0, .keep_count = 1}, now).removed, 2U);
  EXPECT_THAT(*store.list(), ElementsAre("20261102T000000000Z-bbbb", "20261102T000000000Z-aaaa"));
}

/// A clock that was wrong for a day: the scans made since were removed as soon as they were there.
TEST_F(ResultStoreOnDisk, LosesNothingToResultsThatAWrongClockDatedLater) {
  for (const auto* id : {"20900101T000000000Z-aaaa", "20900102T000000000Z-aaaa",
                         "20261101T000000000Z-aaaa", "20261102T000000000Z-aaaa"}) {
    put(id);
  }
  const auto now = *time_of_scan_id("20261104T000000000Z-aaaa");
  const auto swept = store.sweep({.keep_days = 0, .keep_count = 2}, now);
  EXPECT_EQ(swept.removed, 0U);
  EXPECT_EQ(swept.made_later, 2U);
  EXPECT_EQ(newest(now), "20261102T000000000Z-aaaa");
  EXPECT_EQ(newest(*time_of_scan_id("20100101T000000000Z-aaaa")), "20900102T000000000Z-aaaa")
      << "of none that is of its time, the newest";
}

/// A clock that was set back by some minutes: the customer before was the latest, and what was
/// stored was removed at once.
TEST_F(ResultStoreOnDisk, KeepsAndFindsWhatItStoredLastWhateverItsDate) {
  const auto now = *time_of_scan_id("20261121T090000000Z-aaaa");
  put("20261121T090320000Z-aaaa");
  put("20261121T090000000Z-aaaa");
  put("20261121T090000000Z-bbbb");
  EXPECT_EQ(*store.find("latest", now), "20261121T090000000Z-bbbb");
  EXPECT_EQ(store.sweep({.keep_days = 0, .keep_count = 1}, now).removed, 1U);
  EXPECT_THAT(*store.list(), ElementsAre("20261121T090000000Z-bbbb", "20261121T090000000Z-aaaa"));
}

/// They were removed for their age at the next start, minutes after they were made.
TEST_F(ResultStoreOnDisk, KeepsWhatAClockWithoutTimeDatedBeforeThisProgram) {
  for (const auto* id : {"19730501T000000000Z-aaaa", "19730501T000100000Z-aaaa",
                         "20261101T000000000Z-aaaa", "20261102T000000000Z-aaaa"}) {
    put(id);
  }
  const auto now = *time_of_scan_id("20261104T000000000Z-aaaa");
  const auto swept = store.sweep({.keep_days = 30, .keep_count = 1}, now);
  EXPECT_EQ(swept.removed, 1U) << "of those whose age is known";
  EXPECT_EQ(swept.made_before_all, 2U);
  EXPECT_EQ(store.list()->size(), 3U);
}

TEST_F(ResultStoreOnDisk, LimitsTheNumberWhereTheClockNeverKnowsTheTime) {
  for (const auto* id : {"19700101T000100000Z-aaaa", "19700101T000200000Z-aaaa"}) put(id);
  const auto now = *time_of_scan_id("19700301T000000000Z-aaaa");
  EXPECT_EQ(store.sweep({.keep_days = 30, .keep_count = 1}, now).removed, 1U);
  EXPECT_THAT(*store.list(), ElementsAre("19700101T000200000Z-aaaa"));
}

TEST_F(ResultStoreOnDisk, SweepsPastWhatCannotBeRemoved) {
  put("20261101T000000000Z-aaaa");
  put("20261102T000000000Z-aaaa");
  put("20261103T000000000Z-aaaa");
  // What stands in the way of the one that is looked at first.
  const auto day = folder.path() / "scans/2026/11/02";
  std::ofstream(day / ".deleting-20261102T000000000Z-aaaa") << "in the way";
  const auto now = *time_of_scan_id("20261104T000000000Z-aaaa");
  const auto swept = store.sweep({.keep_days = 0, .keep_count = 1}, now);
  EXPECT_EQ(swept.removed, 1U);
  EXPECT_TRUE(swept.trouble);
  EXPECT_THAT(*store.list(), ElementsAre("20261103T000000000Z-aaaa", "20261102T000000000Z-aaaa"));
}

TEST_F(ResultStoreOnDisk, SweepsNoMoreOnceItIsNotWanted) {
  put("20261101T000000000Z-aaaa");
  put("20261102T000000000Z-aaaa");
  put("20261103T000000000Z-aaaa");
  int asked = 0;
  const auto swept =
      store.sweep({.keep_days = 0, .keep_count = 1}, *time_of_scan_id("20261104T000000000Z-aaaa"),
                  [&] { return ++asked == 1; });
  EXPECT_EQ(swept.removed, 1U);
  EXPECT_EQ(asked, 2);
  EXPECT_TRUE(swept.is_interrupted);
  const auto rest =
      store.sweep({.keep_days = 0, .keep_count = 1}, *time_of_scan_id("20261104T000000000Z-aaaa"));
  EXPECT_EQ(rest.removed, 1U);
  EXPECT_FALSE(rest.is_interrupted);
}

}  // namespace
}  // namespace instep
