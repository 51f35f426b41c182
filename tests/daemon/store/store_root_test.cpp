#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "daemon/scan/scan_id.h"
#include "daemon/store/posix_storage.h"
#include "daemon/store/put_together.h"
#include "daemon/store/result_store.h"
#include "tests/daemon/store/simulated_disk.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kOld = "20261120T080000000Z-aaaa";
constexpr const char* kNew = "20261121T091502417Z-k3f9";
const ResultContent kContent{"{}", "ply", "<svg/>", "<svg/>"};

/// A store whose root may come to harm while it is in use.
class StoreRootInUse : public testing::Test {
 protected:
  StoreRootInUse() : store(std::make_shared<PosixStorage>(), folder.path() / "disk/scans") {
    fs::create_directory(folder.path() / "disk");
  }

  test::TemporaryFolder folder;
  ResultStore store;
};

/// It was made anew under the mount point, and scans went to the system's disk.
TEST_F(StoreRootInUse, IsNotMadeAnewWhereItIsGone) {
  ASSERT_TRUE(store.prepare());
  ASSERT_TRUE(store.check_root());
  fs::remove_all(store.root());
  EXPECT_EQ(store.check_root().error().code, ErrorCode::kNotFound);
  EXPECT_THAT(store.check_root().error().line(), HasSubstr("is gone: mount its disk again"));
  EXPECT_FALSE(store.put(kNew, kContent));
  EXPECT_FALSE(store.try_out());
  EXPECT_FALSE(fs::exists(store.root()));
}

/// After one look that missed it, whatever folder stood there was taken for it.
TEST_F(StoreRootInUse, IsKnownAgainByItsMarkAlone) {
  ASSERT_TRUE(store.prepare());
  const auto aside = folder.path() / "aside";
  fs::copy(store.root(), aside);  // no other has its number, as with a disk plugged in again
  fs::remove_all(store.root());
  EXPECT_EQ(store.check_root().error().code, ErrorCode::kNotFound);

  fs::create_directory(store.root());
  EXPECT_EQ(store.check_root().error().code, ErrorCode::kDeviceGone);
  EXPECT_THAT(store.try_out().error().line(), HasSubstr("systemctl restart instepd"));
  std::ofstream(store.root() / "store-id") << "of another store";
  EXPECT_FALSE(store.put(kNew, kContent));
  fs::remove_all(store.root());

  fs::rename(aside, store.root());
  EXPECT_TRUE(store.try_out()) << "it is back";
  EXPECT_TRUE(store.put(kNew, kContent));
  ResultStore second(std::make_shared<PosixStorage>(), store.root());
  EXPECT_TRUE(second.prepare()->is_shared) << "and held again";
}

/// A disk was refused until a restart that came back where it was mounted, as another device.
TEST_F(StoreRootInUse, IsTakenAgainWhereItWasReplacedInOneGo) {
  ASSERT_TRUE(store.prepare());
  fs::copy(store.root(), folder.path() / "same");
  fs::rename(store.root(), folder.path() / "dead");
  fs::rename(folder.path() / "same", store.root());
  EXPECT_TRUE(store.put(kNew, kContent));
  EXPECT_TRUE(fs::exists(store.folder_of(kNew)));
}

/// Of a disk with old results that was mounted over the root, a sweep left keep_count.
TEST_F(StoreRootInUse, IsSparedBySweepsAndDeletionsWhereItIsAForeignOne) {
  ASSERT_TRUE(store.prepare());
  ASSERT_TRUE(store.put(kOld, kContent));
  fs::rename(store.root(), folder.path() / "aside");
  ResultStore foreign(std::make_shared<PosixStorage>(), store.root());
  ASSERT_TRUE(foreign.prepare());
  ASSERT_TRUE(foreign.put(kOld, kContent));
  ASSERT_TRUE(foreign.put(kNew, kContent));

  const auto now = *time_of_scan_id("20261122T000000000Z-aaaa");
  const auto swept = store.sweep({.keep_days = 0, .keep_count = 1}, now);
  EXPECT_EQ(swept.removed, 0U);
  EXPECT_FALSE(swept.trouble) << "no result's, but the root's";
  ASSERT_TRUE(swept.root_trouble);
  EXPECT_EQ(swept.root_trouble->code, ErrorCode::kDeviceGone);
  EXPECT_EQ(store.remove(kOld).error().code, ErrorCode::kDeviceGone);
  EXPECT_THAT(*foreign.list(), ElementsAre(kNew, kOld));
}

TEST_F(StoreRootInUse, IsMarkedAnewWhereAPowerCutLeftAnEmptyMark) {
  fs::create_directory(store.root());
  std::ofstream(store.root() / "store-id").flush();
  ASSERT_TRUE(store.prepare());
  EXPECT_GT(fs::file_size(store.root() / "store-id"), 30U);
}

/// A result that was written while another program cleared the store was cleared with the rest.
TEST_F(StoreRootInUse, IsWrittenInOnlyOnceNobodyElseHasItAlone) {
  fs::create_directory(store.root());
  PosixStorage clearing;
  ASSERT_EQ(clearing.take_hold(store.root()), true);
  EXPECT_TRUE(store.prepare()->is_shared);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(store.put(kNew, kContent).error().code, ErrorCode::kBusy);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
  EXPECT_FALSE(fs::exists(store.root() / "2026"));
  const auto cleared = std::async(std::launch::async, [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    clearing.share_hold();
  });
  EXPECT_TRUE(store.put(kNew, kContent));
}

TEST_F(StoreRootInUse, IsNotTheOneThatTookItsPlace) {
  ASSERT_TRUE(store.prepare());
  const auto aside = folder.path() / "aside";
  fs::rename(store.root(), aside);
  fs::create_directory(store.root());
  EXPECT_EQ(store.check_root().error().code, ErrorCode::kDeviceGone);
  EXPECT_EQ(store.check_root().error().remedy, Remedy::kOperator);
  EXPECT_FALSE(store.put(kNew, kContent));
  EXPECT_TRUE(fs::is_empty(store.root()));
  fs::remove(store.root());
  fs::rename(aside, store.root());
  EXPECT_TRUE(store.put(kNew, kContent));
}

TEST_F(StoreRootInUse, IsMissedWhenItsDiskIsTakenAway) {
  const auto disk = folder.path() / "disk";
  const auto mount_disk = [&] { return ::mount("tmpfs", disk.c_str(), "tmpfs", 0, ""); };
  if (::geteuid() != 0 || mount_disk() != 0) GTEST_SKIP() << "needs the right to mount a disk";
  EXPECT_TRUE(store.prepare());
  std::ostringstream mark;
  mark << std::ifstream(store.root() / "store-id").rdbuf();
  EXPECT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
  EXPECT_FALSE(store.put(kNew, kContent));
  EXPECT_TRUE(fs::is_empty(disk)) << "the disk beneath";
  EXPECT_EQ(mount_disk(), 0);
  fs::create_directory(store.root());
  EXPECT_FALSE(store.put(kNew, kContent)) << "another disk";
  std::ofstream(store.root() / "store-id") << mark.str();
  EXPECT_TRUE(store.put(kNew, kContent));
  ::umount2(disk.c_str(), MNT_DETACH);
}

TEST_F(StoreRootInUse, IsMadeOnceItsParentIsThere) {
  ResultStore early(std::make_shared<PosixStorage>(), folder.path() / "late/scans");
  ASSERT_FALSE(early.prepare());
  EXPECT_FALSE(early.try_out());
  fs::create_directory(folder.path() / "late");
  EXPECT_TRUE(early.try_out());
  EXPECT_TRUE(early.put(kNew, kContent));
}

/// A daemon that was started again cleared what the other one of the same store was writing.
TEST_F(StoreRootInUse, IsClearedOnlyWhenNobodyElseWorksInIt) {
  auto first = std::make_optional<ResultStore>(std::make_shared<PosixStorage>(), store.root());
  EXPECT_FALSE(first->prepare()->is_shared);
  auto second = std::make_optional<ResultStore>(std::make_shared<PosixStorage>(), store.root());
  EXPECT_TRUE(second->prepare()->is_shared);
  ASSERT_TRUE(second->put(kOld, kContent));
  const auto half = store.root() / day_folder(kOld) / (std::string(".writing-") + kNew);
  fs::create_directory(half);

  first.reset();
  first.emplace(std::make_shared<PosixStorage>(), store.root());
  EXPECT_TRUE(first->prepare()->is_shared);
  EXPECT_TRUE(fs::exists(half));
  second.reset();
  first.reset();
  first.emplace(std::make_shared<PosixStorage>(), store.root());
  EXPECT_EQ(first->prepare()->cleared, 1U);
}

/// What was written there was never listed, nor did it ever grow old.
TEST_F(StoreRootInUse, HasFoldersThatAreLinksToAnArchive) {
  ASSERT_TRUE(store.prepare());
  const auto archive = folder.path() / "archive";
  fs::create_directories(archive);
  fs::create_directories(store.root() / "2026/11");
  fs::create_directory_symlink(archive, store.root() / "2026/11/20");
  ASSERT_TRUE(store.put(kOld, kContent));
  ASSERT_TRUE(store.put(kNew, kContent));
  EXPECT_TRUE(fs::exists(archive / kOld / "result.json"));
  EXPECT_THAT(*store.list(), ElementsAre(kNew, kOld));
  const auto now = *time_of_scan_id("20261122T000000000Z-aaaa");
  EXPECT_EQ(store.sweep({.keep_days = 0, .keep_count = 1}, now).removed, 1U);
  EXPECT_TRUE(fs::is_empty(archive));
}

TEST_F(StoreRootInUse, SaysOfALinkThatItLeadsNowhere) {
  ASSERT_TRUE(store.prepare());
  fs::create_directories(store.root() / "2026/11");
  fs::create_directory_symlink(folder.path() / "unmounted", store.root() / "2026/11/21");
  const auto stored = store.put(kNew, kContent);
  ASSERT_FALSE(stored);
  EXPECT_THAT(stored.error().line(), HasSubstr("mount the disk that it leads to"));
}

/// Each customer was measured in vain: the trial was made on the disk of the root, which was well.
TEST_F(StoreRootInUse, IsTriedOutWhereTheNextResultWillLie) {
  ASSERT_TRUE(store.prepare());
  fs::create_directories(store.root() / "2026/11");
  fs::create_directory_symlink(folder.path() / "unmounted", store.root() / "2026/11/21");
  EXPECT_TRUE(store.try_out(*time_of_scan_id(kOld)));
  const auto tried = store.try_out(*time_of_scan_id(kNew));
  ASSERT_FALSE(tried);
  EXPECT_THAT(tried.error().line(), HasSubstr("mount the disk that it leads to"));
}

/// Two daemons on one store removed each other's trial, and one of them told of a fault.
TEST_F(StoreRootInUse, IsTriedOutBesideTheTrialOfAnother) {
  ASSERT_TRUE(store.prepare());
  const auto day = store.root() / day_folder(kNew);
  fs::create_directories(day);
  for (const auto& name : {".trying-out", ".trying-out-0"}) std::ofstream(day / name) << "x";
  EXPECT_TRUE(store.try_out(*time_of_scan_id(kNew)));
  EXPECT_EQ(std::distance(fs::directory_iterator(day), fs::directory_iterator()), 2);
  ASSERT_TRUE(store.prepare());
  EXPECT_FALSE(fs::exists(day / ".trying-out-0")) << "nobody else is there";
}

TEST_F(StoreRootInUse, LosesNothingElseThroughALinkInAResult) {
  ASSERT_TRUE(store.prepare());
  ASSERT_TRUE(store.put(kNew, kContent));
  const auto others = folder.path() / "others";
  fs::create_directory(others);
  std::ofstream(others / "work") << "of somebody else";
  fs::create_directory_symlink(others, store.folder_of(kNew) / "notes");
  EXPECT_TRUE(store.remove(kNew));
  EXPECT_TRUE(fs::exists(others / "work"));
}

/// The trial was smaller than a scan: each customer was measured in vain on a disk that was ready.
TEST(StoreTrial, NeedsAsMuchRoomAsTheLargestScan) {
  constexpr std::size_t kMebibyte = 1024 * 1024;
  const auto disk = std::make_shared<test::SimulatedDisk>();
  ResultStore store(disk, "/scans");
  ASSERT_TRUE(store.prepare());
  disk->set_room(5 * kMebibyte);
  EXPECT_TRUE(store.try_out()) << "how large scans are here, nobody knows yet";
  const ResultContent foot{"{}", std::string(3 * kMebibyte, '.'), "", ""};
  const std::vector<NamedContent> pair{{"20261121T091502417Z-aaaa", foot},
                                       {"20261121T091502417Z-bbbb", foot}};
  ASSERT_FALSE(put_together(store, pair, [] {})) << "the second foot has no room";
  EXPECT_EQ(store.try_out().error().code, ErrorCode::kNoSpace);
  disk->set_room(7 * kMebibyte);
  EXPECT_TRUE(store.try_out());
  EXPECT_TRUE(put_together(store, pair, [] {}));
}

}  // namespace
}  // namespace instep
