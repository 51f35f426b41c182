#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "daemon/station/recovery_ladder.h"
#include "tests/support/openni_bus.h"

/// What the recovery makes of what the driver of a sensor really says.
namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
using Step = RecoveryLadder::Step;

constexpr auto kLong = 20000ms;

/// The next failure of a camera that is started and read as often as it takes.
Error next_failure(DepthCamera& camera) {
  while (true) {
    const auto frame = camera.start().and_then([&] { return camera.next_frame(kLong); });
    if (!frame && frame.error().code != ErrorCode::kTimeout) return frame.error();
  }
}

// It was taken for unplugged, opened again without end and never reset.
TEST(OpenniRecovery, ADriverThatCrashesEachTimeIsResetInTheEnd) {
  OpenniBus bus;
  bus.plug_in({.faults = {"crash"}});
  const auto camera = bus.camera();
  RecoveryLadder ladder(true);
  for (int i = 0; i < RecoveryLadder::kReopens; ++i) {
    EXPECT_EQ(ladder.failed(next_failure(*camera)), Step::kReopen);
    EXPECT_EQ(ladder.text(), "opened again, " + std::to_string(i + 1) + " of 3");
  }
  EXPECT_EQ(ladder.failed(next_failure(*camera)), Step::kReset);
}

// It was reset while it opened, and the log said in turn that it was gone and that it opened.
TEST(OpenniRecovery, ASensorThatTakesLongToOpenIsWaitedForAndMissedInTheSameWords) {
  OpenniBus bus;
  bus.plug_in({});
  const auto camera = bus.camera();
  RecoveryLadder ladder(true);
  bus.unplug("A1");
  const Error lost = next_failure(*camera);
  EXPECT_EQ(ladder.failed(lost), Step::kReopen);
  bus.plug_in({.faults = {"hang-open"}});  // all that is to be seen of one that takes seconds
  for (int look = 0; look < 2 * RecoveryLadder::kReopens; ++look) {
    const auto started = camera->start();
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().line(), lost.line());
    EXPECT_EQ(ladder.failed(started.error()), Step::kReopen);
    EXPECT_EQ(ladder.text(), "waits until it is plugged in");
  }
}

}  // namespace
}  // namespace instep::test
