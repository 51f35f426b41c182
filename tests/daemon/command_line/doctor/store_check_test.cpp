#include "daemon/command_line/doctor/store_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

#include "drivers/files/system_user.h"
#include "tests/support/stranger.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;

DoctorCheck check_of_stranger(const std::filesystem::path& store, std::optional<uid_t> daemon) {
  return test::as_stranger([&] { return check_store(store, daemon); });
}

TEST(StoreCheck, NeedsNoRightOfWhoeverAsks) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to give a folder away";
  const test::TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  const auto store = folder.path() / "store";
  std::filesystem::create_directory(store);
  std::filesystem::permissions(store, std::filesystem::perms(0755));
  const auto roots = check_of_stranger(store, std::nullopt);
  EXPECT_FALSE(roots.good) << "no daemon runs as root";
  EXPECT_THAT(roots.finding, HasSubstr("the daemon may not write"));
  EXPECT_THAT(roots.remedy, testing::Not(HasSubstr("usermod")));
  EXPECT_TRUE(check_of_stranger(store, 0).good);
  const auto of_another = check_of_stranger(store, 1);  // a store that the running one cannot use
  EXPECT_FALSE(of_another.good);
  EXPECT_THAT(of_another.remedy, HasSubstr("sudo chown " + user_name(1)));

  const auto* daemon = ::getpwnam("instep");
  ASSERT_EQ(::chown(store.c_str(), daemon != nullptr ? daemon->pw_uid : 1, 1), 0);
  std::filesystem::permissions(store, std::filesystem::perms(0750));
  const auto daemons = check_of_stranger(store, std::nullopt);
  EXPECT_TRUE(daemons.good) << daemons.finding;
  std::filesystem::permissions(store, std::filesystem::perms(0550));
  EXPECT_FALSE(check_of_stranger(store, std::nullopt).good) << "its owner may not write either";
}

}  // namespace
}  // namespace instep
