#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

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
class StoreRoot : public testing::Test {
 protected:
  StoreRoot() : store(std::make_shared<PosixStorage>(), folder.path() / "disk/scans") {
    fs::create_directory(folder.path() / "disk");
  }

  test::TemporaryFolder folder;
  ResultStore store;
};

/// It was made anew under the mount point, and scans went to the system's disk.
TEST_F(StoreRoot, IsNotMadeAnewWhereItIsGone) {
  ASSERT_TRUE(store.prepare());
  ASSERT_TRUE(store.check_root());
  fs::remove_all(store.root());
  EXPECT_EQ(store.check_root().error().code, ErrorCode::kNotFound);
  EXPECT_THAT(store.check_root().error().line(), HasSubstr("is gone: mount its disk again"));
  EXPECT_FALSE(store.put(kNew, kContent));
  EXPECT_FALSE(store.try_out());
  EXPECT_FALSE(fs::exists(store.root()));

  fs::create_directory(store.root());
  EXPECT_TRUE(store.try_out()) << "it is back";
  EXPECT_TRUE(store.put(kNew, kContent));
  ResultStore second(std::make_shared<PosixStorage>(), store.root());
  EXPECT_TRUE(second.prepare()->is_shared) << "and held again";
}

TEST_F(StoreRoot, IsNotTheOneThatTookItsPlace) {
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

TEST_F(StoreRoot, IsMissedWhenItsDiskIsTakenAway) {
  const auto disk = folder.path() / "disk";
  const auto mount_disk = [&] { return ::mount("tmpfs", disk.c_str(), "tmpfs", 0, ""); };
  if (::geteuid() != 0 || mount_disk() != 0) GTEST_SKIP() << "needs the right to mount a disk";
  EXPECT_TRUE(store.prepare());
  EXPECT_EQ(::umount2(disk.c_str(), MNT_DETACH), 0);
  EXPECT_FALSE(store.put(kNew, kContent));
  EXPECT_TRUE(fs::is_empty(disk)) << "the disk beneath";
  EXPECT_EQ(mount_disk(), 0);
  fs::create_directory(store.root());
  EXPECT_TRUE(store.put(kNew, kContent));
  ::umount2(disk.c_str(), MNT_DETACH);
}

TEST_F(StoreRoot, IsMadeOnceItsParentIsThere) {
  ResultStore early(std::make_shared<PosixStorage>(), folder.path() / "late/scans");
  ASSERT_FALSE(early.prepare());
  EXPECT_FALSE(early.try_out());
  fs::create_directory(folder.path() / "late");
  EXPECT_TRUE(early.try_out());
  EXPECT_TRUE(early.put(kNew, kContent));
}

/// A daemon that was started again cleared what the other one of the same store was writing.
TEST_F(StoreRoot, IsClearedOnlyWhenNobodyElseWorksInIt) {
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
TEST_F(StoreRoot, HasFoldersThatAreLinksToAnArchive) {
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

TEST_F(StoreRoot, SaysOfALinkThatItLeadsNowhere) {
  ASSERT_TRUE(store.prepare());
  fs::create_directories(store.root() / "2026/11");
  fs::create_directory_symlink(folder.path() / "unmounted", store.root() / "2026/11/21");
  const auto stored = store.put(kNew, kContent);
  ASSERT_FALSE(stored);
  EXPECT_THAT(stored.error().line(), HasSubstr("mount the disk that it leads to"));
}

TEST_F(StoreRoot, LosesNothingElseThroughALinkInAResult) {
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
