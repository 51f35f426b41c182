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

}  // namespace
}  // namespace instep::test
