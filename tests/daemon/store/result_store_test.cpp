#include "daemon/store/result_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <iterator>
#include <new>
#include <thread>

#include "daemon/machine/folder_rights.h"
#include "daemon/scan/scan_id.h"
#include "daemon/scan/scan_record.h"
#include "daemon/store/posix_storage.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::ElementsAre;

class ResultStoreOnDisk : public testing::Test {
 protected:
  ResultStoreOnDisk() : store(std::make_shared<PosixStorage>(), folder.path() / "scans") {
    EXPECT_TRUE(store.prepare());
  }
  void put(const std::string& id) { ASSERT_TRUE(store.put(id, {"{}", "ply", "<svg/>", "<svg/>"})); }
  /// After a restart, by the ids alone.
  std::string newest(std::chrono::system_clock::time_point now) const {
    return ResultStore(std::make_shared<PosixStorage>(), store.root()).find("latest", now).value();
  }

  test::TemporaryFolder folder;
  ResultStore store;
};

mode_t mode(const std::filesystem::path& path) {
  struct stat there {};
  EXPECT_EQ(::stat(path.c_str(), &there), 0);
  return there.st_mode & 07777;
}

TEST_F(ResultStoreOnDisk, LaysAResultInTheFolderOfItsDayForTheGroupToRead) {
  const auto at = store.put("20261121T091502417Z-k3f9", {"{}", "ply", "<svg/>", "<svg/>"});
  ASSERT_TRUE(at);
  EXPECT_EQ(*at, folder.path() / "scans/2026/11/21/20261121T091502417Z-k3f9");
  EXPECT_EQ(mode(*at), 0750U);
  EXPECT_EQ(mode(folder.path() / "scans/2026"), 0750U);
  for (const auto* file : {"result.json", "cloud.ply", "sections.svg", "report.svg"}) {
    EXPECT_EQ(mode(*at / file), 0640U) << file;
  }
}

/// One that is only slow passed for one that hangs.
TEST_F(ResultStoreOnDisk, TellsOfEachDayThatItReads) {
  put("20261102T000000000Z-aaaa");
  put("20261103T000000000Z-aaaa");
  put("20261103T000000000Z-bbbb");
  int days = 0;
  EXPECT_EQ(store.list([&] { ++days; })->size(), 3U);
  EXPECT_EQ(days, 2);
  const auto now = std::chrono::system_clock::now();
  store.sweep({.keep_days = 0, .keep_count = 9}, now, always, [&] { ++days; });
  EXPECT_EQ(days, 4);
}

TEST_F(ResultStoreOnDisk, ListsNewestFirstAndFindsTheLatest) {
  put("20251231T235959999Z-aaaa");
  put("20261121T091502417Z-k3f9");
  put("20261121T091502416Z-zzzz");
  EXPECT_THAT(*store.list(), ElementsAre("20261121T091502417Z-k3f9", "20261121T091502416Z-zzzz",
                                         "20251231T235959999Z-aaaa"));
  EXPECT_EQ(newest(*time_of_scan_id("20261121T100000000Z-aaaa")), "20261121T091502417Z-k3f9");
  EXPECT_EQ(store.find("20261121T091502417Z-aaaa").error().code, ErrorCode::kNotFound);
}

TEST_F(ResultStoreOnDisk, RefusesIdsThatLeadElsewhere) {
  for (const auto* id : {"", "..", "../../../etc", "20261121T091502417Z-k3/9", "latest/..",
                         "20261121T091502417Z-k3f9x", "2026112xT091502417Z-k3f9"}) {
    EXPECT_EQ(store.find(id).error().code, ErrorCode::kInvalidInput) << id;
    EXPECT_FALSE(store.put(id, {})) << id;
    EXPECT_FALSE(store.remove(id)) << id;
  }
}

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

TEST_F(ResultStoreOnDisk, PassesOverWhatIsNotItsOwn) {
  put("20261121T091502417Z-k3f9");
  std::filesystem::create_directories(folder.path() / "scans/notes/of");
  std::ofstream(folder.path() / "scans/2026/README") << "mine";
  EXPECT_EQ(store.list()->size(), 1U);
}

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

TEST_F(ResultStoreOnDisk, FindsTheOneBeforeWhereTheLatestWasDeleted) {
  put("20261121T090320000Z-aaaa");
  put("20261121T090000000Z-aaaa");
  put("20261121T085500000Z-aaaa");
  ASSERT_TRUE(store.remove("20261121T085500000Z-aaaa"));
  std::filesystem::remove_all(store.folder_of("20261121T090320000Z-aaaa"));
  EXPECT_EQ(*store.find("latest", *time_of_scan_id("20261121T090500000Z-aaaa")),
            "20261121T090000000Z-aaaa");
}

/// After a restart nothing but the ids tells which one is the latest.
TEST_F(ResultStoreOnDisk, DatesWhatComesNextJustAfterTheNewest) {
  const auto now = *time_of_scan_id("20261121T090000000Z-aaaa");
  EXPECT_EQ(store.time_of_next(now), now) << "nothing is there";
  put("20261121T085959999Z-aaaa");
  EXPECT_EQ(store.time_of_next(now), now);
  put("20261121T090320417Z-aaaa");
  EXPECT_EQ(store.time_of_next(now), *time_of_scan_id("20261121T090320418Z-aaaa"));
  put("20900101T000000000Z-aaaa");
  EXPECT_EQ(store.time_of_next(now), *time_of_scan_id("20261121T090320418Z-aaaa"))
      << "what a wrong clock dated much later does not count";
}

/// A disk that stalls then would stall a scan that is yet to be measured.
TEST_F(ResultStoreOnDisk, DatesWhatComesNextWithoutALookAtTheDisk) {
  put("20261121T090320417Z-aaaa");
  ResultStore after_restart(std::make_shared<PosixStorage>(), store.root());
  ASSERT_TRUE(after_restart.prepare());
  std::filesystem::remove_all(store.root());
  EXPECT_EQ(after_restart.time_of_next(*time_of_scan_id("20261121T090000000Z-aaaa")),
            *time_of_scan_id("20261121T090320418Z-aaaa"));
}

/// Clearing reads all days, and may break off; a scan may begin meanwhile.
TEST_F(ResultStoreOnDisk, KnowsTheNewestBeforeItClears) {
  class Memoryless : public PosixStorage {
   public:
    Result<void> remove_folder(const std::filesystem::path&) override { throw std::bad_alloc(); }
  };
  const auto root = folder.path() / "of an earlier run";
  std::filesystem::create_directories(root / "2026/11/21/20261121T090320417Z-aaaa");
  std::filesystem::create_directory(root / "2026/11/21/.writing-20261121T090330000Z-aaaa");
  ResultStore after_restart(std::make_shared<Memoryless>(), root);
  EXPECT_THROW((void)after_restart.prepare(), std::bad_alloc);
  EXPECT_EQ(after_restart.time_of_next(*time_of_scan_id("20261121T090000000Z-aaaa")),
            *time_of_scan_id("20261121T090320418Z-aaaa"));
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

TEST_F(ResultStoreOnDisk, RemovesFoldersWithinAResultToo) {
  put("20261121T091502417Z-k3f9");
  std::filesystem::create_directory(store.folder_of("20261121T091502417Z-k3f9") / "notes");
  std::ofstream(store.folder_of("20261121T091502417Z-k3f9") / "notes/mine") << "wide toe box";
  EXPECT_TRUE(store.remove("20261121T091502417Z-k3f9"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "scans/2026/11/21"));
}

TEST_F(ResultStoreOnDisk, PassesOverAResultInTheFolderOfAnotherDay) {
  put("20261121T091502417Z-k3f9");
  std::filesystem::create_directory(folder.path() / "scans/2026/11/21/20261120T091502417Z-k3f9");
  EXPECT_THAT(*store.list(), ElementsAre("20261121T091502417Z-k3f9"));
  EXPECT_FALSE(store.find("20261120T091502417Z-k3f9"));
}

/// Its reader waited for ever, and whoever asked after it.
TEST_F(ResultStoreOnDisk, ReadsNoPipe) {
  put("20261121T091502417Z-k3f9");
  const auto file = store.folder_of("20261121T091502417Z-k3f9") / "result.json";
  std::filesystem::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(store.read_result_json("20261121T091502417Z-k3f9").error().code,
            ErrorCode::kCorruptData);
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

TEST_F(ResultStoreOnDisk, NeverOverwritesAResult) {
  put("20261121T091502417Z-k3f9");
  EXPECT_FALSE(store.put("20261121T091502417Z-k3f9", {"other", "", "", ""}));
  EXPECT_EQ(*store.read_result_json("20261121T091502417Z-k3f9"), "{}");
}

TEST(StorageError, NamesAFullDiskAndMissingRights) {
  EXPECT_EQ(storage_error(ENOSPC, "write", "/d/x", "/d").code, ErrorCode::kNoSpace);
  EXPECT_EQ(storage_error(EDQUOT, "write", "/d/x", "/d").code, ErrorCode::kNoSpace);
  EXPECT_EQ(storage_error(EACCES, "write", "/d/x", "/d").code, ErrorCode::kPermissionDenied);
  EXPECT_THAT(storage_error(EROFS, "write", "/d/x", "/d").line(), testing::HasSubstr("read-only"));
  EXPECT_THAT(storage_error(EROFS, "write", "/d/x", "/d").line(),
              testing::HasSubstr("ReadWritePaths= (systemctl edit instepd)"));
  EXPECT_EQ(storage_error(EIO, "write", "/d/x", "/d").remedy, Remedy::kOperator);
  EXPECT_THAT(storage_error(ENOSPC, "write", "/d/x", "/d").line(), testing::HasSubstr("disk"));
}

TEST(StorageError, SaysToWhomAFolderIsToBeGiven) {
  const auto line = storage_error(EACCES, "write", "/d/x", "/d").line();
  EXPECT_THAT(line, testing::HasSubstr("sudo chown " + user_name(::geteuid()) + " /d"));
}

/// It was ready, and the first foot was measured in vain.
TEST(ResultStoreOfAnotherUser, IsNotReady) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to be another user";
  const test::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  std::filesystem::create_directory(folder.path() / "scans");
  std::filesystem::permissions(folder.path() / "scans", std::filesystem::perms(0755));
  ResultStore store(std::make_shared<PosixStorage>(), folder.path() / "scans");
  Result<Prepared> prepared;
  std::thread([&] {
    constexpr int kNobody = 65534;  // that thread alone
    ::syscall(SYS_setresuid, kNobody, kNobody, kNobody);
    prepared = store.prepare();
  }).join();
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().code, ErrorCode::kPermissionDenied);
  EXPECT_THAT(prepared.error().line(), testing::HasSubstr("sudo chown " + user_name(65534) + " " +
                                                          (folder.path() / "scans").string()));
}

/// It was to be given a folder that was not there.
TEST(ResultStoreOfAnotherUser, IsToldWhichFolderHidesThePlace) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to be another user";
  const test::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  const auto closed = folder.path() / "closed";
  std::filesystem::create_directory(closed);
  std::filesystem::permissions(closed, std::filesystem::perms(0700));
  ResultStore store(std::make_shared<PosixStorage>(), closed / "missing/scans");
  Result<Prepared> prepared;
  std::thread([&] {
    constexpr int kNobody = 65534;  // that thread alone
    ::syscall(SYS_setresuid, kNobody, kNobody, kNobody);
    prepared = store.prepare();
  }).join();
  ASSERT_FALSE(prepared);
  EXPECT_THAT(prepared.error().advice, testing::HasSubstr("may not look into " + closed.string()));
  EXPECT_THAT(prepared.error().advice, testing::Not(testing::HasSubstr("chown")));
}

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
