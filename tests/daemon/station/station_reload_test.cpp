#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "daemon/station/station.h"
#include "daemon/store/posix_storage.h"
#include "tests/support/loop_thread.h"
#include "tests/support/small_station.h"
#include "tests/support/station_on_loop.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

/// A station at work that notes what each of its scans was to be measured with, and fails them.
class ReloadedStation : public test::StationOnLoop {
 protected:
  struct Measured {
    std::optional<double> platform_height_mm;
    std::optional<Side> side;
  };

  ReloadedStation() {
    listener_.on_failure = [this](const Error&) { ++ended_; };
    measure_ = [this](const Capture& capture, const PipelineSettings& pipeline,
                      const ScanProgress&) -> Result<std::vector<ScanRecord>> {
      measured_ = {capture.platform_height_mm, pipeline.side};
      return fail(ErrorCode::kInsufficientData, "nothing stands there", "");
    };
    begin(test::small_station());
  }
  ~ReloadedStation() override { loop_.stop(); }

  void reload(const Settings& settings) {
    loop_.call([&] { station_->reload(settings); });
  }
  /// What a scan is measured with.
  Measured scan() {
    EXPECT_TRUE(comes_to(StationState::kReady));
    const int before = ended_;
    loop_.call([&] { EXPECT_TRUE(station_->request_scan()); });
    EXPECT_TRUE(loop_.wait_until([&] { return ended_ > before; }));
    return measured_;
  }

  /// Frames that the camera has given, for scans and looks.
  std::uint64_t frames() {
    std::uint64_t good = 0;
    loop_.call([&] {
      const auto status = station_->status();
      if (!status.cameras.empty()) good = status.cameras[0].frames.good;
    });
    return good;
  }

 private:
  Measured measured_;
  int ended_ = 0;
};

TEST_F(ReloadedStation, GoesBackToWhatTheCamerasSayWhereASettingIsTakenOut) {
  const auto by_cameras = scan();
  ASSERT_EQ(by_cameras.platform_height_mm, 0.0) << "the simulation stands at 0";
  auto settings = test::small_station();
  settings.station.platform_height_mm = 12.5;
  settings.station.side = Side::kLeft;
  reload(settings);
  const auto by_settings = scan();
  EXPECT_EQ(by_settings.platform_height_mm, 12.5);
  EXPECT_EQ(by_settings.side, Side::kLeft);
  reload(test::small_station());
  const auto again = scan();
  EXPECT_EQ(again.platform_height_mm, 0.0);
  EXPECT_EQ(again.side, std::nullopt);
}

// The new time counted only from the next look on, which might be an hour away.
TEST_F(ReloadedStation, LooksAtItsCamerasAsOftenAsTheNewSettingsSay) {
  scan();
  auto settings = test::small_station();
  settings.capture.check_every = std::chrono::hours(1);
  reload(settings);
  settings.capture.check_every = std::chrono::seconds(1);
  reload(settings);
  const auto before = frames();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (frames() < before + 4 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_GE(frames(), before + 4);
}

TEST(StationWarnings, TellOfAPlatformThatTheCamerasWereNotCalibratedFor) {
  test::LoopThread loop;
  const test::TemporaryFolder folder;
  auto settings = test::small_station();
  settings.calibration = AppliedCalibration{};
  settings.calibration->placed = {"left"};
  settings.calibration->platform_height_mm = 0.0;
  std::optional<Station> station;
  std::vector<std::string> before;
  std::vector<std::string> after;
  loop.call([&] {
    auto store = std::make_shared<ResultStore>(std::make_shared<PosixStorage>(), folder.path());
    station.emplace(loop.loop(), settings, MeasureCapture(), store, StationListener());
    before = station->status().warnings;
    settings.station.platform_height_mm = 12.5;
    settings.calibration.reset();  // a file that is gone leaves the poses that are in use
    station->reload(settings);
    after = station->status().warnings;
    station.reset();
  });
  EXPECT_TRUE(before.empty());
  ASSERT_EQ(after.size(), 1U);
  EXPECT_NE(after[0].find("platform_height_mm is 12.5, and was 0"), std::string::npos) << after[0];
}

}  // namespace
}  // namespace instep
