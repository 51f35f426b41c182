#include "daemon/machine/device_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/fake_usb_bus.h"
#include "tests/support/stranger.h"

namespace instep {
namespace {

using testing::HasSubstr;

/// A machine whose folders of /sys and /dev are made up.
class DeviceChecks : public testing::Test {
 protected:
  DeviceFolders folders() const { return {bus_.sysfs(), bus_.dev()}; }

  void plug(const test::FakeUsbBus::Camera& camera) {
    bus_.plug(camera);
    std::filesystem::create_directories(bus_.dev());
    for (const int number : camera.nodes) {
      std::ofstream(bus_.dev() / ("video" + std::to_string(number))) << "";
    }
  }
  void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }

  /// The camera with serial A1 in socket 2.
  static V4l2Settings wanted() {
    V4l2Settings settings;
    settings.serial = "A1";
    settings.bus_path = "usb-0000:00:14.0-2";
    return settings;
  }
  DeviceTrouble trouble() const {
    return trouble_of_camera(wanted(), folders()).value_or(DeviceTrouble{"none", "none"});
  }

  test::FakeUsbBus bus_;
  test::FakeUsbBus::Camera camera_{
      .port = "2", .serial = "A1", .nodes = {0}, .speed_mbps = 5000, .usb_version = " 3.20"};
};

TEST_F(DeviceChecks, FindNothingWrongWithACameraInItsPlace) {
  plug(camera_);
  EXPECT_FALSE(trouble_of_camera(wanted(), folders())) << trouble().finding;
}

TEST_F(DeviceChecks, SayThatACameraIsNotPluggedIn) {
  EXPECT_THAT(trouble().finding, HasSubstr("no camera with serial A1"));
  EXPECT_THAT(trouble().remedy, HasSubstr("plug it in"));
}

TEST_F(DeviceChecks, SayThatTheDriverIsMissing) {
  camera_.nodes.clear();
  plug(camera_);
  EXPECT_THAT(trouble().finding, HasSubstr("no driver serves it"));
  EXPECT_EQ(trouble().remedy, "sudo modprobe uvcvideo");
}

TEST_F(DeviceChecks, SayThatACameraIsInAnothersPlace) {
  camera_.port = "3.1";
  plug(camera_);
  EXPECT_EQ(trouble().finding,
            "it is plugged into usb-0000:00:14.0-3.1, not into "
            "usb-0000:00:14.0-2");
  EXPECT_THAT(trouble().remedy, HasSubstr("bus_path = \"usb-0000:00:14.0-3.1\""));
}

TEST_F(DeviceChecks, SayThatThisUserMayNotOpenIt) {
  plug(camera_);
  std::filesystem::permissions(bus_.dev().parent_path(), std::filesystem::perms(0755));
  std::filesystem::permissions(bus_.dev() / "video0", std::filesystem::perms::none);
  const auto closed = test::as_stranger([this] { return trouble(); });
  EXPECT_THAT(closed.finding, HasSubstr("Permission denied"));
  EXPECT_THAT(closed.remedy, HasSubstr("sudo usermod -aG video"));
  EXPECT_TRUE(closed.is_closed);
  std::filesystem::remove(bus_.dev() / "video0");
  EXPECT_FALSE(trouble().is_closed);
}

TEST_F(DeviceChecks, SayThatTheNodeWasNotMade) {
  plug(camera_);
  std::filesystem::remove(bus_.dev() / "video0");
  EXPECT_THAT(trouble().finding, HasSubstr("video0 cannot be opened: No such file"));
  EXPECT_EQ(trouble().remedy, "sudo udevadm trigger");
}

TEST_F(DeviceChecks, SayThatAUsb3CameraHangsOnASlowLink) {
  camera_.speed_mbps = 480;
  plug(camera_);
  EXPECT_THAT(trouble().finding, HasSubstr("a USB 3 camera on a link of 480 Mbit/s"));
}

// The kernel's 16 MB starve the second OpenNI2 sensor.
TEST_F(DeviceChecks, UsbfsMemoryIsChecked) {
  write(bus_.sysfs() / "module/usbcore/parameters/usbfs_memory_mb", "16");
  EXPECT_FALSE(trouble_of_usb_memory(folders()));
  for (const char* port : {"4", "5"}) {
    bus_.plug({.port = port, .serial = port});
    write(bus_.usb_folder(port) / "idVendor", "1d27");
    EXPECT_EQ(trouble_of_usb_memory(folders()).has_value(), port[0] == '5');
  }
  EXPECT_THAT(trouble_of_usb_memory(folders())->remedy, HasSubstr("echo 32 | sudo tee"));
  write(bus_.sysfs() / "module/usbcore/parameters/usbfs_memory_mb", "0");
  EXPECT_FALSE(trouble_of_usb_memory(folders())) << "0 is no limit";
}

}  // namespace
}  // namespace instep
