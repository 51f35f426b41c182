#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "daemon/station/recovery_ladder.h"
#include "tests/kernel/devices/one_camera_station.h"
#include "tests/support/station_process.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::steady_clock;
using testing::HasSubstr;

class V4l2Recovery : public testing::Test {
 protected:
  void start(UsbDepthCamera& usb) {
    usb.plug();
    station_.write_settings(one_camera_settings());
    station_.start();
    ASSERT_TRUE(station_.wait_for("STATUS=ready", 20s)) << station_.log();
  }
  json status() { return station_.connect().value().ask("status").value()["cameras"][0]; }
  /// The camera's status, once `text` is in it.
  std::string status_with(const std::string& text) {
    const auto deadline = steady_clock::now() + 30s;
    while (steady_clock::now() < deadline) {
      if (const auto now = status().dump(); now.find(text) != std::string::npos) return now;
      std::this_thread::sleep_for(50ms);
    }
    return status().dump();
  }

  StationProcess station_;
};

// It is there, but sends nothing.
TEST_F(V4l2Recovery, OpensAgainThenResetsThenCallsAPersonAndNeverGivesUpLooking) {
  UsbDepthCamera usb({}, flat_scene());
  start(usb);
  const int set_ups = usb.set_ups();
  usb.fall_silent(true);
  EXPECT_EQ(station_.run_instep("scan").exit_code, 1);
  EXPECT_THAT(status_with("opened again"), HasSubstr("opened again"));
  EXPECT_THAT(status_with("USB reset"), HasSubstr("USB reset"));
  EXPECT_THAT(status_with("needs a person"), HasSubstr("needs a person"));
  EXPECT_EQ(usb.set_ups() - set_ups, RecoveryLadder::kResets);
  std::this_thread::sleep_for(5s);
  EXPECT_EQ(usb.set_ups() - set_ups, RecoveryLadder::kResets) << "no more resets";
  usb.fall_silent(false);
  EXPECT_TRUE(station_.wait_for("STATUS=ready", 10s)) << station_.log();
}

// Such a link works, and fails after hours.
TEST_F(V4l2Recovery, WarnsOfAUsb3CameraOnAUsb2Link) {
  UsbDepthCamera usb({.usb_version = 0x0210}, flat_scene());
  start(usb);
  EXPECT_THAT(status_with("480 Mbit/s"), HasSubstr("as USB 2"));
  EXPECT_EQ(status()["link_mbps"], 480);
  EXPECT_THAT(station_.run_instep("status").text, HasSubstr("ok, but it is linked at 480 Mbit/s"));
}

}  // namespace
}  // namespace instep::test
