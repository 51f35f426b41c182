#include "drivers/openni2/child_process.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

namespace {

/// How many calls a signal cuts short.
int cut_short = 0;

}  // namespace

/// Stands before that of the C library: no signal comes at the moment that it takes.
extern "C" pid_t waitpid(pid_t child, int* status, int options) {
  static const auto real =
      reinterpret_cast<pid_t (*)(pid_t, int*, int)>(::dlsym(RTLD_NEXT, "waitpid"));
  if (cut_short == 0) return real(child, status, options);
  --cut_short;
  errno = EINTR;
  return -1;
}

namespace instep {
namespace {

// It was taken for one that had ended, and was never reaped.
TEST(ChildProcessFault, RunsOnThoughASignalCutsTheLookAtItShort) {
  auto child = ChildProcess::start({"/bin/sleep", {"60"}, {}, {}, std::nullopt});
  ASSERT_TRUE(child) << child.error().line();
  cut_short = 2;
  EXPECT_EQ(child->wait(std::chrono::milliseconds(0)), std::nullopt);
}

TEST(ChildProcessFault, SaysHowItEndedThoughASignalCutsTheLookAtItShort) {
  auto child = ChildProcess::start({"/bin/sh", {"-c", "exit 3"}, {}, {}, std::nullopt});
  ASSERT_TRUE(child) << child.error().line();
  cut_short = 2;
  EXPECT_EQ(child->wait(std::chrono::seconds(30)), "ended with code 3");
}

}  // namespace
}  // namespace instep
