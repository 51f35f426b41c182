#include "daemon/scan/scan_id.h"

#include <gtest/gtest.h>

#include <chrono>

namespace instep {
namespace {

TEST(ScanIds, AreSortableByTimeAndUnlikeAnyOther) {
  using namespace std::chrono;
  const auto time = sys_days(2026y / 11 / 21) + 9h + 15min + 2s + 417ms;
  const auto id = new_scan_ids(time, 1).front();
  EXPECT_EQ(id.substr(0, 20), "20261121T091502417Z-");
  EXPECT_TRUE(is_scan_id(id));
  EXPECT_EQ(*time_of_scan_id(id), time);
  EXPECT_LT(id.substr(0, 19), new_scan_ids(time + 1ms, 1).front().substr(0, 19));
  EXPECT_FALSE(time_of_scan_id("20261321T091502417Z-aaaa"));
}

TEST(ScanIds, OfTheFeetOfOneScanBelongTogetherInTheirOrder) {
  using namespace std::chrono;
  const auto time = sys_days(2026y / 11 / 21) + 9h;
  const auto ids = new_scan_ids(time, 3);
  ASSERT_EQ(ids.size(), 3U);
  EXPECT_LT(ids[0], ids[1]);
  EXPECT_LT(ids[1], ids[2]);
  EXPECT_TRUE(are_of_one_scan(ids[0], ids[2]));
  EXPECT_FALSE(are_of_one_scan(ids[0], new_scan_ids(time + 1ms, 1).front()));
  EXPECT_FALSE(are_of_one_scan("", ""));
}

}  // namespace
}  // namespace instep
