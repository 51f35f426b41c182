#include "daemon/command_line/station_recording.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/recording/recording_reader.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using Images = std::map<std::string, std::vector<std::vector<std::uint16_t>>>;

/// What each camera of a small simulated station gives, image by image.
Images recorded(int warmup_frames, std::size_t frames) {
  Settings settings;
  settings.cameras.emplace_back();
  settings.simulation.cameras = 2;
  settings.simulation.width_px = 64;
  settings.simulation.height_px = 48;
  settings.simulation.pacing = SimulatedPacing::kAsFastAsPossible;
  settings.simulation.truth = false;
  settings.capture.warmup_frames = warmup_frames;
  const test::TemporaryFolder folder;
  const StopRequest stop;
  const auto recording =
      record_station(settings, {frames, std::nullopt}, folder.path() / "visit", stop);
  if (!recording) throw std::runtime_error(recording.error().line());
  const auto taken = read_recorded_frames(*recording);
  if (!taken) throw std::runtime_error(taken.error().line());
  Images images;
  for (const auto& frame : *taken) images[frame.camera].push_back(frame.raw);
  return images;
}

TEST(StationRecording, LeavesOutTheFramesThatTheSettingsSayWarmACameraUp) {
  const auto all = recorded(0, 5);
  const auto warm = recorded(3, 2);
  ASSERT_EQ(all.size(), 2U);
  for (const auto& [camera, images] : all) {
    ASSERT_NE(images[2], images[3]) << "the noise of no two frames is the same";
    const std::vector last(images.begin() + 3, images.end());
    EXPECT_EQ(warm.at(camera), last) << camera;
  }
}

}  // namespace
}  // namespace instep
