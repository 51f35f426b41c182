#include "drivers/files/file_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>

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

}  // namespace
}  // namespace instep
