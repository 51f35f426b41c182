#include "daemon/machine/folder_rights.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

constexpr uid_t kOwner = 54321;  // whom the system does not know
constexpr uid_t kAnother = 54322;

TEST(FolderRights, AreThoseOfWhoeverAsks) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to give a folder away";
  const test::TemporaryFolder folder;
  const auto path = folder.path();
  ASSERT_EQ(::chown(path.c_str(), kOwner, kOwner), 0);
  const auto may = [&](unsigned mode, uid_t user) {
    std::filesystem::permissions(path, std::filesystem::perms(mode));
    return may_write_in(path, user);
  };
  EXPECT_TRUE(may(0700, kOwner));
  EXPECT_FALSE(may(0500, kOwner));
  EXPECT_FALSE(may(0677, kOwner));
  EXPECT_FALSE(may(0770, kAnother)) << "it is not in the group";
  EXPECT_TRUE(may(0703, kAnother));
  EXPECT_TRUE(may(0000, 0));
  EXPECT_EQ(advice_to_give(path, kAnother), "sudo chown 54322 " + path.string());
  EXPECT_EQ(advice_to_give(path, kOwner), "sudo chmod u+rwx " + path.string());
}

TEST(FolderRights, OfAFolderThatIsNotThereAreUnknown) {
  EXPECT_TRUE(may_write_in("/none/at/all", kOwner));
}

}  // namespace
}  // namespace instep
