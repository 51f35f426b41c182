#include "config/calibration/warnings_of_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace instep {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

CameraSettings sensor(const std::string& name, const std::string& serial) {
  CameraSettings camera;
  camera.kind = CameraKind::kOpenni;
  camera.openni.placement.name = name;
  camera.openni.serial = serial;
  return camera;
}

CameraSettings video(const std::string& name, const std::string& serial) {
  CameraSettings camera;
  camera.kind = CameraKind::kV4l2;
  camera.v4l2.placement.name = name;
  camera.v4l2.serial = serial;
  return camera;
}

/// Two cameras that were calibrated as the units 111 and 222, on a platform at 5 mm.
Settings station(const std::string& left_serial, const std::string& right_serial) {
  Settings settings;
  settings.station.platform_height_mm = 5.0;
  settings.cameras = {sensor("left", left_serial), video("right", right_serial)};
  AppliedCalibration calibration;
  calibration.file = "/etc/c.toml";
  calibration.time = "2026-11-28T02:11:12Z";
  calibration.placed = {"left", "right"};
  calibration.serials = {{"left", "111"}, {"right", "222"}};
  calibration.platform_height_mm = 5.0;
  settings.calibration = calibration;
  return settings;
}

TEST(WarningsOfPoses, AreNoneWhereTheStationIsTheCalibratedOne) {
  EXPECT_THAT(warnings_of_poses(station("111", "222"), {}), IsEmpty());
  EXPECT_THAT(warnings_of_poses(station("", ""), {{"left", "111"}, {"right", "222"}}), IsEmpty());
  EXPECT_THAT(warnings_of_poses(station("", ""), {}), IsEmpty()) << "nobody knows";
  EXPECT_THAT(warnings_of_poses(Settings(), {}), IsEmpty());
  auto old = station("111", "333");
  old.calibration->serials.clear();
  old.calibration->platform_height_mm.reset();
  EXPECT_THAT(warnings_of_poses(old, {}), IsEmpty()) << "it keeps nothing to compare with";
}

TEST(WarningsOfPoses, TellOfAUnitThatWasSwapped) {
  const auto is_swapped = ElementsAre(
      AllOf(HasSubstr("right is the unit 333, and 222 was calibrated, which makes measures wrong"),
            HasSubstr("run instep calibrate again")));
  EXPECT_THAT(warnings_of_poses(station("111", "333"), {}), is_swapped);
  EXPECT_THAT(warnings_of_poses(station("111", "333"), {{"right", "333"}}), is_swapped) << "once";
  // A socket has a name in the settings, and its camera tells what it is.
  EXPECT_THAT(warnings_of_poses(station("111", ""), {{"left", "111"}, {"right", "333"}}),
              is_swapped);
  EXPECT_THAT(warnings_of_poses(station("", ""), {{"left", ""}, {"right", "333"}}), is_swapped);
}

TEST(WarningsOfPoses, TellOfPosesAndOfAHeightThatTheSettingsHaveChangedSince) {
  auto settings = station("111", "222");
  settings.calibration->moved = {"left"};
  settings.station.platform_height_mm.reset();  // which is 0 to a calibration
  EXPECT_THAT(warnings_of_poses(settings, {}),
              ElementsAre(HasSubstr("left stands elsewhere by the settings"),
                          HasSubstr("platform_height_mm is 0, and was 5 when")));
  settings.calibration->moved.clear();
  settings.calibration->platform_height_mm = 0.0;
  EXPECT_THAT(warnings_of_poses(settings, {}), IsEmpty());
}

TEST(WarningsOfPoses, TellOfCamerasThatNoCalibrationPlaced) {
  auto settings = station("111", "222");
  settings.calibration->placed = {"left"};
  settings.calibration->left_out = {"right"};
  settings.cameras[1].placement()->is_rough = true;
  EXPECT_THAT(warnings_of_poses(settings, {}),
              ElementsAre(HasSubstr("placed by tape measure alone"),
                          HasSubstr("/etc/c.toml does not hold right: run instep calibrate")));
}

}  // namespace
}  // namespace instep
