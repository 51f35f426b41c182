#include "drivers/files/system_user.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <thread>

namespace instep {
namespace {

TEST(SystemUser, HasANumberForItsNameWhereNobodyKnowsIt) {
  EXPECT_EQ(user_name(0), "root");
  EXPECT_EQ(user_name(54321), "54321");
}

/// The daemon told whoever read its status to let themselves in, which did not help the daemon.
TEST(SystemUser, IsTheOneOfThisProgramWhoIsToJoinAGroup) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to become another user";
  std::string command;
  std::thread([&] {  // it alone is another user's
    constexpr int kNumberOfBin = 2;
    ::syscall(SYS_setresuid, kNumberOfBin, kNumberOfBin, kNumberOfBin);
    command = command_to_join("video");
  })
      .join();
  EXPECT_EQ(command, "sudo usermod -aG video bin");
  EXPECT_EQ(command_to_join("plugdev"), "sudo usermod -aG plugdev root");
}

}  // namespace
}  // namespace instep
