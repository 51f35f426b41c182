#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "config/settings_file.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kPose =
    "station_from_camera = [1, 0, 0, 0,  0, -1, 0, 0,  0, 0, -1, 500,  0, 0, 0, 1]\n";

/// Five lines and those of `address`.
std::string openni(const std::string& name, const std::string& address) {
  return "[[camera]]\nkind = \"openni2\"\nname = \"" + name + "\"\n" + kPose + address;
}

std::string v4l2(const std::string& name, const std::string& address) {
  return "[[camera]]\nkind = \"v4l2\"\nname = \"" + name + "\"\ndepth_unit_mm = 1.0\n" + kPose +
         "intrinsics = { width = 64, height = 48, fx = 60, fy = 60, cx = 32, cy = 24 }\n" + address;
}

std::vector<std::string> faults_of(const std::string& toml) {
  return read_settings(toml, "/etc/s.toml").faults;
}

TEST(DistinctCameras, MayShareWhatDoesNotMakeThemTheSame) {
  EXPECT_THAT(faults_of(openni("a", "serial = \"1\"\n") + openni("b", "serial = \"2\"\n") +
                        v4l2("c", "serial = \"1\"\n") + v4l2("d", "bus_path = \"usb-x-2\"\n")),
              IsEmpty());
  // Makers give all of a batch one number: their sockets tell them apart.
  EXPECT_THAT(faults_of(v4l2("a", "serial = \"0001\"\nbus_path = \"usb-x-1\"\n") +
                        v4l2("b", "serial = \"0001\"\nbus_path = \"usb-x-2\"\n")),
              IsEmpty());
}

TEST(DistinctCameras, OfOneNameAreRefusedAcrossKinds) {
  EXPECT_THAT(faults_of(openni("a", "serial = \"1\"\n") + v4l2("a", "serial = \"2\"\n")),
              ElementsAre("/etc/s.toml:6: the [[camera]] of line 1 has the name a too"));
}

TEST(DistinctCameras, OfOneOpenniSensorAreRefusedWithBothLines) {
  EXPECT_THAT(faults_of(openni("a", "serial = \"1\"\n") + openni("b", "serial = \"1\"\n")),
              ElementsAre("/etc/s.toml:6: the [[camera]] of line 1 has the serial 1 too"));
  // One without a serial takes the only sensor there is, which may be the other's.
  for (const char* other : {"", "serial = \"1\"\n"}) {
    EXPECT_THAT(faults_of(openni("a", "") + openni("b", other)),
                ElementsAre(HasSubstr("s.toml:5: the [[camera]] of line 1 has kind \"openni2\" "
                                      "too, and of several each needs a serial")));
  }
}

TEST(DistinctCameras, OfOneV4l2DeviceAreRefusedWithBothLines) {
  const std::string socket = "bus_path = \"usb-x-1\"\n";
  EXPECT_THAT(faults_of(v4l2("a", "serial = \"1\"\n") + v4l2("b", "serial = \"1\"\n" + socket)),
              ElementsAre(HasSubstr(":8: the [[camera]] of line 1 has the serial 1 too")));
  EXPECT_THAT(
      faults_of(v4l2("a", "serial = \"1\"\n" + socket) + v4l2("b", "serial = \"2\"\n" + socket)),
      ElementsAre(HasSubstr(":9: the [[camera]] of line 1 has the bus_path usb-x-1 too")));
}

TEST(DistinctCameras, AreTheSourcesThatBringSeveral) {
  const std::string simulated = "[[camera]]\nkind = \"simulated\"\n";
  const std::string recording = "[[camera]]\nkind = \"recording\"\npath = \"visit\"\n";
  EXPECT_THAT(faults_of(simulated + recording), IsEmpty());
  EXPECT_THAT(faults_of(simulated + simulated),
              ElementsAre(HasSubstr(":3: the [[camera]] of line 1 has kind \"simulated\" too")));
  EXPECT_THAT(faults_of(recording + recording),
              ElementsAre(HasSubstr(":4: the [[camera]] of line 1 has the path /etc/visit too")));
}

// A misspelt kind is taken for a simulated camera no further than its own fault.
TEST(DistinctCameras, AreNotAskedOfOnesWithAFault) {
  const std::string misspelt = "[[camera]]\nkind = \"v4l\"\n";
  EXPECT_THAT(faults_of(misspelt + misspelt), ElementsAre(HasSubstr(":2:"), HasSubstr(":4:")));
}

}  // namespace
}  // namespace instep
