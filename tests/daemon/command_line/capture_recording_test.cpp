#include "daemon/command_line/capture_recording.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "daemon/command_line/stop_request.h"
#include "sim/simulated_station.h"
#include "tests/support/model_board.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

SimulatedStation small_station() {
  SimulationSettings settings;
  settings.cameras = 2;
  settings.width_px = 64;
  settings.height_px = 48;
  settings.pacing = Pacing::kAsFastAsPossible;
  return build_station(settings).value();
}

// As `instep record` does it: the signal arrives in the midst of the frames.
TEST(CaptureRecording, EndsAtASignalWithTheLightOffAndNothingKept) {
  const auto station = small_station();
  for (const int number : {SIGINT, SIGTERM}) {
    const test::TemporaryFolder folder;
    test::ModelBoard board;
    int rounds = 0;
    {
      const StopRequest stop;
      const auto light = board.open("projector").value();
      ASSERT_TRUE(light->set(true));
      const auto recording =
          capture_recording(station.cameras, {}, {10000, {}}, folder.path() / "visit", [&](double) {
            EXPECT_TRUE(board.is_on("projector"));
            if (++rounds == 3) raise(number);
            return !stop.is_made();
          });
      ASSERT_FALSE(recording);
      EXPECT_EQ(recording.error().code, ErrorCode::kCancelled);
    }
    EXPECT_EQ(rounds, 3);
    EXPECT_FALSE(board.is_on("projector"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "visit"));
  }
}

TEST(StopRequest, LeavesSignalsAsTheyWere) {
  const auto handler_of = [](int number) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    return now.sa_handler;
  };
  for (int round = 0; round < 2; ++round) {
    {
      const StopRequest stop;
      EXPECT_FALSE(stop.is_made());
      EXPECT_NE(handler_of(SIGINT), SIG_DFL);
      raise(SIGINT);
      EXPECT_TRUE(stop.is_made());
      EXPECT_EQ(handler_of(SIGINT), SIG_DFL) << "a second one ends the program";
    }
    EXPECT_EQ(handler_of(SIGINT), SIG_DFL);
    EXPECT_EQ(handler_of(SIGTERM), SIG_DFL);
  }
}

}  // namespace
}  // namespace instep
