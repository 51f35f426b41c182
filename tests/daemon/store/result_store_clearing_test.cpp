#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <iterator>
#include <new>
#include <thread>

#include "tests/daemon/store/result_store_on_disk.h"

namespace instep {
namespace {

using test::ResultStoreOnDisk;
using testing::ElementsAre;

TEST_F(ResultStoreOnDisk, ClearsWhatAnEarlierRunLeft) {
  put("20261121T091502417Z-k3f9");
  const auto day = folder.path() / "scans/2026/11/21";
  std::filesystem::create_directory(day / ".writing-20261121T091502418Z-aaaa");
  std::ofstream(day / ".writing-20261121T091502418Z-aaaa/cloud.ply") << "half";
  std::filesystem::create_directory(day / ".deleting-20261121T091502419Z-aaaa");
  EXPECT_EQ(store.prepare()->cleared, 2U);
  EXPECT_EQ(store.prepare()->cleared, 0U);
  EXPECT_THAT(*store.list(), ElementsAre("20261121T091502417Z-k3f9"));
}

/// A scan came with its result only once the folders of all days were read and cleared; and what
/// stored it let others in, whose half-made results were cleared then.
TEST_F(ResultStoreOnDisk, StoresAndRemovesBetweenTwoDaysOfTheClearingAndKeepsOthersOut) {
  const ResultContent content{"{}", "ply", "<svg/>", "<svg/>"};
  const std::string removed = "20261123T000000000Z-aaaa";
  const auto root = folder.path() / "of an earlier run";
  for (const auto* day : {"20", "21", "22"}) {
    std::filesystem::create_directories(root / "2026/11" / day /
                                        (std::string(".writing-202611") + day));
  }
  ResultStore after_restart(std::make_shared<PosixStorage>(), root);
  std::future<void> storing;
  int days = 0;
  const auto prepared = after_restart.prepare([&] {
    if (++days != 2) return;
    storing = std::async(std::launch::async, [&] {
      EXPECT_TRUE(after_restart.put("20261122T000000000Z-aaaa", content));
      EXPECT_TRUE(after_restart.put(removed, content));
      EXPECT_TRUE(after_restart.remove(removed));
    });
    ASSERT_EQ(storing.wait_for(std::chrono::seconds(30)), std::future_status::ready);
    PosixStorage other;
    EXPECT_EQ(other.take_hold(root), false);
    EXPECT_EQ(other.keep_hold(root).error().code, ErrorCode::kBusy);
  });
  EXPECT_EQ(prepared->cleared, 3U);
  EXPECT_THAT(*after_restart.list(), ElementsAre("20261122T000000000Z-aaaa"));
  PosixStorage other;
  EXPECT_EQ(other.take_hold(root), false);
  EXPECT_TRUE(other.keep_hold(root)) << "others are let in at its end";
}

/// A disk that stalls at listing one day, and sees what is stored when it lists the next one.
class StallingStorage : public PosixStorage {
 public:
  Result<std::vector<Entry>> list(const std::filesystem::path& path) override {
    if (path == stalled && stalls.exchange(false)) {
      listing.set_value();
      go_on.get_future().wait();
    }
    if (path == next) is_stored_at_next = std::filesystem::exists(result);
    return PosixStorage::list(path);
  }

  std::filesystem::path stalled, next, result;
  std::promise<void> listing;
  std::promise<void> go_on;
  std::atomic<bool> stalls = false;
  bool is_stored_at_next = false;
};

/// Whether a thread of this process sleeps.
bool sleeps(long thread) {
  std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
  const std::string stat{std::istreambuf_iterator<char>(file), {}};
  const auto name_end = stat.rfind(')');
  return name_end != std::string::npos && stat.compare(name_end, 3, ") S") == 0;
}

/// It would wait for all days, if the clearing took them before it.
TEST_F(ResultStoreOnDisk, StoresWhatWaitsWhileADayIsClearedBeforeTheNextOne) {
  const std::string id = "20261122T000000000Z-aaaa";
  const auto root = folder.path() / "of an earlier run";
  const auto storage = std::make_shared<StallingStorage>();
  storage->stalled = root / "2026/11/20";
  storage->next = root / "2026/11/21";
  storage->result = root / "2026/11/22" / id;
  std::filesystem::create_directories(storage->stalled);
  std::filesystem::create_directories(storage->next);
  ResultStore after_restart(storage, root);
  auto preparing = std::async(
      std::launch::async, [&] { return after_restart.prepare([&] { storage->stalls = true; }); });
  storage->listing.get_future().wait();
  std::promise<long> thread;
  auto storing = std::async(std::launch::async, [&] {
    thread.set_value(::syscall(SYS_gettid));
    return after_restart.put(id, {"{}", "ply", "<svg/>", "<svg/>"});
  });
  const long stores = thread.get_future().get();
  while (!sleeps(stores)) std::this_thread::yield();
  storage->go_on.set_value();
  EXPECT_TRUE(storing.get());
  EXPECT_TRUE(preparing.get());
  EXPECT_TRUE(storage->is_stored_at_next);
}

/// Another folder in its place was cleared, and its mark taken for the store's own; or the store
/// was not known again, once it was back.
TEST_F(ResultStoreOnDisk, ClearsNothingInAFolderThatTookItsPlaceMeanwhile) {
  const auto root = folder.path() / "of an earlier run";
  const auto leftover = root / "2026/11/21/.writing-20261121";
  std::filesystem::create_directories(leftover);
  ResultStore after_restart(std::make_shared<PosixStorage>(), root);
  const auto prepared = after_restart.prepare([&] {
    std::filesystem::rename(root, folder.path() / "aside");
    std::filesystem::create_directories(leftover);
  });
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().code, ErrorCode::kDeviceGone);
  EXPECT_TRUE(std::filesystem::exists(leftover));
  EXPECT_FALSE(std::filesystem::exists(root / "store-id"));
  EXPECT_FALSE(after_restart.try_out());
  std::filesystem::remove_all(root);
  std::filesystem::rename(folder.path() / "aside", root);
  EXPECT_TRUE(after_restart.try_out());
}

/// Nobody else could store anything, until the daemon that had been short of memory was ended.
TEST_F(ResultStoreOnDisk, LetsOthersInThoughItsClearingBrokeOff) {
  put("20261121T091502417Z-k3f9");
  ASSERT_THROW((void)store.prepare([] { throw std::bad_alloc(); }), std::bad_alloc);
  PosixStorage other;
  EXPECT_EQ(other.take_hold(store.root()), false);
  EXPECT_TRUE(other.keep_hold(store.root()));
}

/// A second daemon cleared what the first one was about to store.
TEST_F(ResultStoreOnDisk, LeavesWhatAnotherProgramIsMaking) {
  put("20261121T091502417Z-k3f9");
  const auto half = folder.path() / "scans/2026/11/21/.writing-20261121T091502418Z-aaaa";
  std::filesystem::create_directory(half);
  {
    ResultStore second(std::make_shared<PosixStorage>(), folder.path() / "scans");
    const auto prepared = second.prepare();
    EXPECT_TRUE(prepared->is_shared);
    EXPECT_EQ(prepared->cleared, 0U);
  }
  EXPECT_TRUE(std::filesystem::exists(half));
  EXPECT_FALSE(store.prepare()->is_shared) << "its own hold is none of another";
  EXPECT_FALSE(std::filesystem::exists(half));
}

}  // namespace
}  // namespace instep
