#include "drivers/files/system_user.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/stranger.h"

namespace instep {
namespace {

TEST(SystemUser, HasANumberForItsNameWhereNobodyKnowsIt) {
  EXPECT_EQ(user_name(0), "root");
  EXPECT_EQ(user_name(54321), "54321");
}

/// The daemon told whoever read its status to let themselves in, which did not help the daemon.
TEST(SystemUser, IsTheOneOfThisProgramWhoIsToJoinAGroup) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  EXPECT_EQ(test::as_stranger([] { return command_to_join("video"); }),
            "sudo usermod -aG video nobody");
  EXPECT_EQ(command_to_join("plugdev"), "sudo usermod -aG plugdev root");
}

}  // namespace
}  // namespace instep
