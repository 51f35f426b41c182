#include "daemon/command_line/recordings/station_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "daemon/control/unix_socket.h"
#include "drivers/recording/recording_reader.h"
#include "tests/support/small_station.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using Images = std::map<std::string, std::vector<std::vector<std::uint16_t>>>;

/// What each camera of a small simulated station gives, image by image.
Images recorded(int warmup_frames, std::size_t frames) {
  Settings settings = test::small_station();
  settings.simulation.cameras = 2;
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

TEST(StationRecording, SaysThatTheDaemonHasTheCameras) {
  const test::TemporaryFolder folder;
  Settings settings;
  settings.cameras.emplace_back();
  settings.cameras[0].kind = CameraKind::kOpenni;
  settings.cameras[0].openni.serial = "none";
  settings.control.socket = folder.path() / "control.sock";
  const StopRequest stop;
  const auto record = [&] {
    return record_station(settings, {1, std::nullopt}, folder.path() / "visit", stop);
  };
  const auto alone = record();
  ASSERT_FALSE(alone);
  EXPECT_NE(alone.error().code, ErrorCode::kBusy) << alone.error().line();

  const auto daemon = ListeningSocket::open(settings.control.socket);
  ASSERT_TRUE(daemon) << daemon.error().line();
  const auto recording = record();
  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().code, ErrorCode::kBusy);
  EXPECT_THAT(recording.error().message, testing::StartsWith("the daemon has the cameras"));
  EXPECT_THAT(recording.error().advice, testing::StartsWith("systemctl stop instepd"));
}

// Of a socket that this user may not use it was taken that nobody listens there.
TEST(StationRecording, OpensNoCameraWhenItCannotBeToldWhetherADaemonHasIt) {
  const test::TemporaryFolder folder;
  Settings settings;
  settings.cameras.emplace_back();
  settings.cameras[0].kind = CameraKind::kOpenni;
  settings.control.socket = folder.path() / "control.sock";
  std::ofstream(settings.control.socket) << "no socket";
  const StopRequest stop;
  const auto recording = record_station(settings, {1, std::nullopt}, folder.path() / "visit", stop);
  ASSERT_FALSE(recording);
  EXPECT_THAT(recording.error().message,
              testing::StartsWith("it cannot be told whether a daemon has the cameras"));
}

TEST(StationRecording, LeavesADaemonThatSimulatesItsOwnCamerasAlone) {
  const test::TemporaryFolder folder;
  Settings settings = test::small_station();
  settings.control.socket = folder.path() / "control.sock";
  const auto daemon = ListeningSocket::open(settings.control.socket);
  ASSERT_TRUE(daemon) << daemon.error().line();
  const StopRequest stop;
  const auto recording = record_station(settings, {1, std::nullopt}, folder.path() / "visit", stop);
  EXPECT_TRUE(recording) << recording.error().line();
}

}  // namespace
}  // namespace instep
