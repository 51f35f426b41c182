#include "drivers/openni2/openni_child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <fstream>
#include <thread>

#include "tests/support/openni_bus.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

constexpr auto kLong = 20000ms;

/// A program in the place of instep-openni: says what its sensor ails once there is a file "told"
/// beside it, and ends without having read what it was told.
std::filesystem::path deaf_program(const std::filesystem::path& folder, const Error& ailment) {
  const auto path = folder / "deaf";
  std::ofstream(path) << "#!/bin/sh\nuntil [ -e " << (folder / "told").string()
                      << " ]; do sleep 0.01; done\n"
                      << "printf %s '" << to_text(ChildMessage(ailment)) << "' >&4\nexit 1\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

// The kernel tells that a command was not read before it hands out the last words: a sensor that
// was unplugged passed for a program that had crashed.
TEST(OpenniChildFault, HearsTheLastWordsOfOneThatEndsUnreadACommand) {
  const TemporaryFolder folder;
  const Error unplugged{ErrorCode::kDeviceGone, Remedy::kReopen, "it was unplugged", "plug it in"};
  auto child = OpenniChild::launch({deaf_program(folder.path(), unplugged), {}}, {}).value();
  const WakeUp interrupt;
  child->start();  // though this one never opens a sensor
  const auto process = child_processes().at(0);
  std::ofstream(folder.path() / "told") << '\n';
  while (runs(process, "deaf")) std::this_thread::yield();
  const auto started =
      child->wait_for(OpenniChild::Phase::kStreaming, steady_clock::now() + kLong, interrupt);
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().line(), unplugged.line());
  EXPECT_EQ(started.error().code, unplugged.code);
}

/// Of several sensors that were plugged in at once, the last ones passed for hanging while the
/// others were opened before them, and had to begin anew.
TEST(OpenniChildFault, WaitsForItsTurnLongerThanAnOpeningMayTake) {
  constexpr auto kOpeningLimit = 2000ms;
  OpenniBus bus;
  bus.plug_in({});
  // As another process does that opens its sensor.
  Descriptor other(::open(bus.folder().c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
  SensorChoice choice;
  choice.serial = "A1";
  choice.opening_limit = kOpeningLimit;
  const auto child = OpenniChild::launch(bus.program(), choice).value();
  const WakeUp interrupt;
  const auto waiting = child->wait_for(OpenniChild::Phase::kOpen,
                                       steady_clock::now() + 2 * kOpeningLimit, interrupt);
  ASSERT_FALSE(waiting);
  EXPECT_EQ(waiting.error().code, ErrorCode::kTimeout) << waiting.error().line();
  EXPECT_TRUE(child->is_well());
  other = Descriptor();
  const auto opened =
      child->wait_for(OpenniChild::Phase::kOpen, steady_clock::now() + kLong, interrupt);
  EXPECT_TRUE(opened) << opened.error().line();
}

}  // namespace
}  // namespace instep::test
