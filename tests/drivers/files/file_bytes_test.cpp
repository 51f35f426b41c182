#include "drivers/files/file_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;

TEST(FileBytes, OfADiskThatTakesNoneAreNoMatterOfPermission) {
  const test::TemporaryFolder folder;
  if (::geteuid() != 0 || ::mount("tmpfs", folder.path().c_str(), "tmpfs", MS_RDONLY, "") != 0) {
    GTEST_SKIP() << "needs the right to mount a disk";
  }
  const auto written = write_file_bytes(folder.path() / "file", "bytes");
  ::umount(folder.path().c_str());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kIo);
  EXPECT_THAT(written.error().line(), HasSubstr("mounted read-only, often after a disk error"));
}

TEST(FileBytes, OfAFileThatIsNotOnesOwnAreAMatterOfPermission) {
  EXPECT_EQ(file_error(EACCES, "write", "/file").code, ErrorCode::kPermissionDenied);
}

mode_t mode_of(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
}

TEST(FileBytes, ReplaceNoPipeDeviceOrFolder) {
  const test::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("/dev/null", link);
  for (const auto& path : {pipe, link, folder.path()}) {
    const auto kind = std::filesystem::status(path).type();
    const auto written = write_file_bytes(path, "bytes");
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(written.error().code, ErrorCode::kInvalidInput) << path;
    EXPECT_THAT(written.error().line(), HasSubstr("choose another name"));
    EXPECT_EQ(std::filesystem::status(path).type(), kind) << path;
  }
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(FileBytes, GoWhereALinkLeads) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "disk");
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("disk/file", link);
  for (const char* bytes : {"of a new file", "that replace it"}) {
    ASSERT_TRUE(write_file_bytes(link, bytes));
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(read_file_bytes(folder.path() / "disk" / "file", 100), bytes);
  }
}

TEST(FileBytes, AreAsReadableAsTheFileBeforeOrAsTheUmaskSays) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "file";
  const mode_t before = ::umask(027);
  const auto made = write_file_bytes(file, "new");
  ::umask(before);
  ASSERT_TRUE(made);
  EXPECT_EQ(mode_of(file), 0640U);
  ::umask(077);
  const auto for_all = write_file_bytes(folder.path() / "for all", "new", Readers::kAll);
  ::umask(before);
  ASSERT_TRUE(for_all);
  EXPECT_EQ(mode_of(folder.path() / "for all"), 0644U);
  std::filesystem::remove(folder.path() / "for all");
  ASSERT_EQ(::chmod(file.c_str(), 0604), 0);
  ASSERT_TRUE(write_file_bytes(file, "replaced"));
  EXPECT_EQ(mode_of(file), 0604U);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++entries;
  }
  EXPECT_EQ(entries, 1U);
}

/// Root's calibration of a station whose settings are its user's and group's alone.
TEST(FileBytes, StayThoseOfTheOwnerOfTheFileBefore) {
  constexpr uid_t kOther = 12345;
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "file";
  ASSERT_TRUE(write_file_bytes(file, "old"));
  if (::chown(file.c_str(), kOther, kOther) != 0) GTEST_SKIP() << "needs the right to give files";
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  ASSERT_TRUE(write_file_bytes(file, "replaced"));
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, kOther);
  EXPECT_EQ(status.st_gid, kOther);
  EXPECT_EQ(mode_of(file), 0640U);
}

}  // namespace
}  // namespace instep
