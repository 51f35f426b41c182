#include "daemon/store/result_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "daemon/scan/scan_id.h"
#include "daemon/store/posix_storage.h"
#include "drivers/files/system_user.h"
#include "tests/daemon/store/result_store_on_disk.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using test::ResultStoreOnDisk;
using testing::ElementsAre;

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

TEST_F(ResultStoreOnDisk, PassesOverWhatIsNotItsOwn) {
  put("20261121T091502417Z-k3f9");
  std::filesystem::create_directories(folder.path() / "scans/notes/of");
  std::ofstream(folder.path() / "scans/2026/README") << "mine";
  EXPECT_EQ(store.list()->size(), 1U);
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

TEST_F(ResultStoreOnDisk, NeverOverwritesAResult) {
  put("20261121T091502417Z-k3f9");
  EXPECT_FALSE(store.put("20261121T091502417Z-k3f9", {"other", "", "", ""}));
  EXPECT_EQ(*store.read_result_json("20261121T091502417Z-k3f9"), "{}");
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

}  // namespace
}  // namespace instep
