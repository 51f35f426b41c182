#include "daemon/station/devices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/fake_usb_bus.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The bus with a sensor of this maker and number in socket 2.
class DevicesOnUsb : public testing::Test {
 protected:
  void plug(const std::string& port, const std::string& serial, const std::string& vendor) {
    bus_.plug({.port = port, .serial = serial});
    std::ofstream(bus_.usb_folder(port) / "idVendor") << vendor << "\n";
  }
  std::optional<UsbAddress> address_of(const std::string& serial) const {
    OpenniSettings sensor;
    sensor.serial = serial;
    return usb_address_of(sensor, {bus_.sysfs(), bus_.dev()});
  }

  test::FakeUsbBus bus_;
};

TEST_F(DevicesOnUsb, KnowAnOpenniSensorByItsSerial) {
  plug("2", "A1", "1d27");
  plug("3", "B2", "1d27");
  // Without the socket: it may come back in another.
  EXPECT_EQ(address_of("A1"), (UsbAddress{.bus_path = {}, .serial = "A1"}));
}

// Whatever has the address may be reset.
TEST_F(DevicesOnUsb, TakeNothingElseForAnOpenniSensor) {
  plug("2", "A1", "1d27");
  plug("3", "D1", "0781");
  EXPECT_FALSE(address_of("C3"));
  EXPECT_FALSE(address_of(""));
  EXPECT_FALSE(address_of("D1")) << "a disk with the sensor's number";
  plug("4", "A1", "0781");
  EXPECT_FALSE(address_of("A1")) << "a disk with the sensor's number, beside the sensor";
}

TEST(Devices, AllThatCannotBeOpenedAreNamedBesideThoseThatCan) {
  Settings settings;
  settings.simulation.cameras = 1;
  settings.simulation.width_px = 64;
  settings.simulation.height_px = 48;
  settings.cameras.resize(3);
  for (const int i : {0, 2}) {
    settings.cameras[static_cast<std::size_t>(i)].kind = CameraKind::kRecording;
    settings.cameras[static_cast<std::size_t>(i)].path = "/nowhere/" + std::to_string(i);
  }
  const auto devices = open_devices(settings);
  ASSERT_FALSE(devices);
  settings.cameras = {settings.cameras[1]};
  const auto simulated = open_devices(settings);
  ASSERT_TRUE(simulated) << simulated.error().line();
  const std::string name = simulated->cameras.front()->description().geometry.id;
  EXPECT_THAT(devices.error().message, AllOf(HasSubstr("/nowhere/0"), HasSubstr("/nowhere/2"),
                                             HasSubstr("(no fault so far: " + name + ")")));
}

/// A camera that is away is a device all the same, and needs none.
CameraSettings video_camera(const std::string& name) {
  CameraSettings camera;
  camera.kind = CameraKind::kV4l2;
  camera.v4l2.placement.name = name;
  camera.v4l2.placement.intrinsics =
      CameraIntrinsics{.width = 640, .height = 480, .fx = 383, .fy = 383, .cx = 319, .cy = 239};
  camera.v4l2.serial = "not plugged in: " + name;
  camera.v4l2.depth_unit_mm = 1.0;
  return camera;
}

TEST(Devices, SayWhereTheirPosesComeFrom) {
  Settings settings;
  settings.cameras = {video_camera("left"), video_camera("right")};
  const auto said = [&] {
    const auto devices = open_devices(settings);
    return devices ? devices->calibration : devices.error().line();
  };
  EXPECT_EQ(said(), "as the settings say");
  settings.calibration = AppliedCalibration{
      "/etc/instep/calibration.toml", "2026-11-28T02:11:12Z", {"left", "right"}, {}, {}};
  EXPECT_EQ(said(), "instep calibrate, 2026-11-28T02:11:12Z");
  settings.calibration->placed = {"left"};
  settings.calibration->left_out = {"right"};
  EXPECT_EQ(said(), "instep calibrate, 2026-11-28T02:11:12Z; right as the settings say");
  settings.cameras[1].placement()->is_rough = true;
  EXPECT_EQ(said(), "instep calibrate, 2026-11-28T02:11:12Z; right by tape measure");
  settings.calibration->placed.clear();
  EXPECT_EQ(said(), "as the settings say; right by tape measure");
  settings.cameras[0].placement()->is_rough = true;
  EXPECT_EQ(said(), "by tape measure");
}

}  // namespace
}  // namespace instep
