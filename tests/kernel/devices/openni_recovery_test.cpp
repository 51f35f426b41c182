#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "daemon/station/recovery_ladder.h"
#include "drivers/usb/usb_devices.h"
#include "tests/kernel/devices/one_camera_station.h"
#include "tests/support/openni_bus.h"
#include "tests/support/station_process.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;
using testing::HasSubstr;

/// An OpenNI2 sensor in two halves, since no software speaks a real one's language on the wire: the
/// USB device is on the kernel's bus, where it comes, goes and is reset; the depth is that of our
/// driver module behind the stock library. The serial number is what joins them, as with a real
/// one.
class OpenniSensorOnUsb : public testing::Test {
 protected:
  void SetUp() override {
    plug_in();
    station_.write_settings(
        "[[camera]]\nkind = \"openni2\"\nname = \"only\"\nserial = \"P1\"\nlibrary_folder = \"" +
        bus_.folder().string() +
        "\"\nstation_from_camera = [ 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 500, 0, 0, 0, 1 ]\n"
        "[capture]\ncheck_every_s = 3600\nframe_limit_ms = 300\n");
    station_.start();
    ASSERT_TRUE(station_.wait_for("STATUS=ready", 40s)) << station_.log();
  }
  /// Whoever can open a real sensor finds it on the bus.
  void plug_in() {
    usb_.plug();
    const auto deadline = steady_clock::now() + 20s;
    while (!is_on_usb() && steady_clock::now() < deadline) std::this_thread::sleep_for(20ms);
    bus_.plug_in({.serial = "P1"});
  }
  static bool is_on_usb() {
    const auto devices = list_usb_devices("/sys", "/dev");
    return std::any_of(devices.begin(), devices.end(),
                       [](const auto& one) { return one.device.address.serial == "P1"; });
  }
  void unplug() {
    bus_.unplug("P1");
    usb_.unplug();
  }
  /// The camera's status, once `text` is in it.
  std::string status_with(const std::string& text) {
    const auto deadline = steady_clock::now() + 40s;
    while (true) {
      const auto now = station_.connect().value().ask("status").value()["cameras"][0].dump();
      if (now.find(text) != std::string::npos || steady_clock::now() > deadline) return now;
      std::this_thread::sleep_for(50ms);
    }
  }

  OpenniBus bus_;
  UsbDepthCamera usb_{{.serial = "P1", .vendor = 0x1d27}, flat_scene()};
  StationProcess station_;
};

// Nobody would look at it for an hour, but for the news of the bus.
TEST_F(OpenniSensorOnUsb, IsMissedAndTakenBackAtOnceByTheNewsOfTheBus) {
  EXPECT_THAT(status_with("\"link_mbps\":480"), HasSubstr("\"link_mbps\":480"));
  for (int round = 0; round < 2; ++round) {
    unplug();
    ASSERT_TRUE(station_.wait_for("STATUS=degraded", 10s)) << station_.log();
    EXPECT_THAT(status_with("\"link_mbps\":0"), HasSubstr("waits until it is plugged in"));
    plug_in();
    ASSERT_TRUE(station_.wait_for("STATUS=ready", 10s)) << station_.log();
  }
}

// The reset is a real one, of the device on the kernel's bus.
TEST_F(OpenniSensorOnUsb, IsOpenedAgainThenResetThenLeftToAPerson) {
  const int set_ups = usb_.set_ups();
  bus_.set_faults("P1", {"stall"});
  EXPECT_EQ(station_.run_instep("scan").exit_code, 1);
  EXPECT_THAT(status_with("opened again"), HasSubstr("opened again"));
  EXPECT_THAT(status_with("USB reset"), HasSubstr("USB reset"));
  EXPECT_THAT(status_with("needs a person"), HasSubstr("needs a person"));
  EXPECT_EQ(usb_.set_ups() - set_ups, RecoveryLadder::kResets);
  bus_.set_faults("P1", {});
  EXPECT_TRUE(station_.wait_for("STATUS=ready", 20s)) << station_.log();
}

}  // namespace
}  // namespace instep::test
