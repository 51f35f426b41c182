#include "daemon/store/put_together.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/daemon/store/simulated_disk.h"

namespace instep {
namespace {

using test::FaultyStorage;
using test::SimulatedDisk;

const std::vector<NamedContent> kFeet = {
    {"20261121T091502417Z-k3f9", {"{}", "ply", "<svg/>", "<svg/>"}},
    {"20261121T091502418Z-bbbb", {"{}", "ply", "<svg/>", "<svg/>"}}};

/// A disk that filled up after the first foot kept that one, and whoever scanned again had it
/// twice.
TEST(PutTogether, KeepsBothFeetOrNoneWhicheverCallFails) {
  std::size_t call = 1;
  for (bool struck = true; struck; ++call) {
    const auto disk = std::make_shared<SimulatedDisk>();
    ASSERT_TRUE(ResultStore(disk, "/scans").prepare());
    const auto faulty = std::make_shared<FaultyStorage>(disk, FaultyStorage::Fault::kNoSpace, call);
    ResultStore store(faulty, "/scans");
    std::size_t steps = 0;
    const auto folders = put_together(store, kFeet, [&] { ++steps; });
    struck = faulty->struck();
    EXPECT_EQ(folders.has_value(), !struck) << "call " << call;
    EXPECT_EQ(ResultStore(disk, "/scans").list()->size(), struck ? 0U : 2U) << "call " << call;
    if (!struck) {
      EXPECT_EQ(steps, 2U);
      EXPECT_EQ(folders->back(), store.folder_of(kFeet.back().id));
    }
  }
  EXPECT_GT(call, 30U);
}

TEST(PutTogether, NamesWhatCannotBeRemovedAgain) {
  const auto disk = std::make_shared<SimulatedDisk>();
  ASSERT_TRUE(ResultStore(disk, "/scans").prepare());
  // Counts the calls for the first foot; the disk dies at the next.
  const auto counted = std::make_shared<SimulatedDisk>();
  ASSERT_TRUE(ResultStore(counted, "/scans").prepare());
  std::size_t call = 1;
  for (bool struck = true; struck; ++call) {
    const auto faulty =
        std::make_shared<FaultyStorage>(counted, FaultyStorage::Fault::kDiesBefore, call);
    struck = !ResultStore(faulty, "/scans").put(kFeet.front().id, kFeet.front().content);
    (void)ResultStore(counted, "/scans").prepare();
    (void)ResultStore(counted, "/scans").remove(kFeet.front().id);
  }
  const auto dying = std::make_shared<FaultyStorage>(disk, FaultyStorage::Fault::kDiesBefore, call);
  ResultStore store(dying, "/scans");
  const auto folders = put_together(store, kFeet, [] {});
  ASSERT_FALSE(folders);
  EXPECT_NE(folders.error().message.find(kFeet.front().id + " is stored and cannot be removed"),
            std::string::npos)
      << folders.error().message;
}

}  // namespace
}  // namespace instep
