#include "drivers/openni2/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <string>

#include "drivers/files/descriptor.h"
#include "tests/support/signal_rain.h"

namespace instep {
namespace {

class ChildProcessTest : public testing::Test {
 protected:
  ChildProcessTest() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::pipe(ends.data()), 0);
    reads_ = Descriptor(ends[0]);
    writes_ = Descriptor(ends[1]);
  }
  /// Writes a line to its first descriptor.
  ChildProgram speaker() const {
    return {"/bin/sh", {"-c", "echo here >&3"}, {}, {writes_.number()}, std::nullopt};
  }
  Descriptor reads_;
  Descriptor writes_;
};

TEST_F(ChildProcessTest, HasTheDescriptorsThatItIsGiven) {
  auto child = ChildProcess::start(speaker());
  ASSERT_TRUE(child) << child.error().line();
  EXPECT_EQ(child->wait(std::chrono::seconds(30)), "ended with code 0");
  std::array<char, 16> text{};
  ASSERT_EQ(::read(reads_.number(), text.data(), text.size()), 5);
  EXPECT_STREQ(text.data(), "here\n");
}

// Started all the same it would speak to nobody, or to a file that was not meant for it.
TEST_F(ChildProcessTest, IsNotStartedWithoutTheDescriptorsThatItIsGiven) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit few{32, limit.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &few);
  const auto child = ChildProcess::start(speaker());
  ::setrlimit(RLIMIT_NOFILE, &limit);
  ASSERT_FALSE(child);
  EXPECT_EQ(child.error().code, ErrorCode::kIo);
  EXPECT_THAT(child.error().line(), testing::HasSubstr("limit on open files"));

  auto without = speaker();
  without.descriptors = {-1};
  const auto closed = ChildProcess::start(without);
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().code, ErrorCode::kIo);
}

// Each signal let it wait for the whole limit again.
TEST_F(ChildProcessTest, IsWaitedForNoLongerThanTheLimitHoweverManySignalsCome) {
  auto child = ChildProcess::start({"/bin/sleep", {"2"}, {}, {}, std::nullopt});
  ASSERT_TRUE(child) << child.error().line();
  const test::SignalRain rain;
  EXPECT_EQ(child->wait(std::chrono::milliseconds(100)), std::nullopt);
}

}  // namespace
}  // namespace instep
