#include "daemon/store/posix_storage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>

#include "drivers/files/system_user.h"

namespace instep {
namespace {

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

}  // namespace
}  // namespace instep
