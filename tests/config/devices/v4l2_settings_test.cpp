#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "config/settings_description.h"
#include "config/settings_file.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kPose =
    "station_from_camera = [ 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 500, 0, 0, 0, 1 ]\n";
constexpr const char* kLens =
    "intrinsics = { width = 640, height = 480, fx = 383, fy = 384, cx = 319, cy = 240 }\n";

SettingsReading read(const std::string& fields) {
  return read_settings("[[camera]]\nkind = \"v4l2\"\nname = \"left\"\n" + fields, "/etc/s.toml");
}

TEST(V4l2Settings, AreReadFromTheirTable) {
  const auto reading =
      read(std::string(kPose) + kLens +
           "serial = \"8193\"\nbus_path = \"usb-0000:00:14.0-2\"\nformat = \"INZI\"\n"
           "depth_unit_mm = 0.125\ncontrols = [ { name = \"auto_exposure\", value = 1 },"
           " { name = \"gain\", value = -3 } ]\n");
  ASSERT_THAT(reading.faults, IsEmpty());
  const auto& camera = reading.settings.cameras.at(0).v4l2;
  EXPECT_EQ(camera.placement.name, "left");
  EXPECT_EQ(camera.placement.intrinsics.value().fy, 384.0);
  EXPECT_EQ(camera.placement.station_from_camera.translation().z(), 500.0);
  EXPECT_EQ(camera.serial, "8193");
  EXPECT_EQ(camera.bus_path, "usb-0000:00:14.0-2");
  EXPECT_EQ(camera.format, V4l2Format::kInzi);
  EXPECT_EQ(camera.depth_unit_mm, 0.125);
  ASSERT_EQ(camera.controls.size(), 2U);
  EXPECT_EQ(camera.controls[0].name, "auto_exposure");
  EXPECT_EQ(camera.controls[1].value, -3);
  EXPECT_THAT(describe(reading.settings), HasSubstr("left, a V4L2 camera, serial 8193"));
}

// What V4L2 does not say has no default: a wrong unit would make every girth wrong.
TEST(V4l2Settings, AreRefusedWithoutWhatV4l2DoesNotSay) {
  const std::string serial = "serial = \"1\"\n";
  const std::string unit = "depth_unit_mm = 1.0\n";
  EXPECT_THAT(read(kPose + serial + unit).faults,
              ElementsAre(HasSubstr("camera.intrinsics is missing")));
  EXPECT_THAT(read(std::string(kPose) + kLens + serial).faults,
              ElementsAre(HasSubstr("camera.depth_unit_mm is missing")));
  EXPECT_THAT(read(std::string(kPose) + kLens + unit).faults,
              ElementsAre(HasSubstr("camera.serial is missing")));
  EXPECT_THAT(read(kLens + serial + unit).faults,
              ElementsAre(HasSubstr("camera.station_from_camera is missing")));
}

TEST(V4l2Settings, AreRefusedWhenTheyCannotBeRight) {
  const std::string rest = std::string(kPose) + kLens + "serial = \"1\"\n";
  EXPECT_THAT(read(rest + "depth_unit_mm = 0\n").faults, ElementsAre(HasSubstr("is outside")));
  EXPECT_THAT(read(rest + "depth_unit_mm = 1\nformat = \"YUYV\"\n").faults,
              ElementsAre(HasSubstr("is not one of \"Z16\", \"Y16\", \"INZI\"")));
  EXPECT_THAT(read(rest + "depth_unit_mm = 1\ncontrols = [ { name = \"gain\" } ]\n").faults,
              ElementsAre(HasSubstr("each has a name and a value")));
  EXPECT_THAT(read(rest + "depth_unit_mm = 1\ndevice = \"/dev/video0\"\n").faults,
              ElementsAre(HasSubstr("there is no setting camera.device")));
}

}  // namespace
}  // namespace instep
