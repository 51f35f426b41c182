#include "daemon/command_line/doctor/doctor_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CameraSettings camera(const std::string& name, bool is_rough) {
  CameraSettings camera;
  camera.kind = CameraKind::kOpenni;
  camera.openni.placement.name = name;
  camera.openni.placement.is_rough = is_rough;
  return camera;
}

AppliedCalibration calibration_of(std::vector<std::string> placed,
                                  std::vector<std::string> left_out) {
  return {"/etc/c.toml", "2026-11-28T02:11:12Z", std::move(placed), std::move(left_out), {}};
}

TEST(CalibrationCheck, IsNotMadeWhereThereIsNothingToCalibrate) {
  Settings settings;
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.cameras.resize(2);  // simulated ones
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.calibration = calibration_of({}, {});
  EXPECT_FALSE(check_calibration(settings, {}));
  settings.calibration.reset();
  settings.cameras = {camera("left", false)};
  EXPECT_FALSE(check_calibration(settings, {})) << "one camera alone";
}

TEST(CalibrationCheck, NamesTheCommandWherePosesAreTheSettingsOwn) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("instep calibrate"));
}

TEST(CalibrationCheck, IsBadWhereATapeMeasureIsAllThatThereIs) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", true)};
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("by tape measure alone: right"));
  EXPECT_EQ(check->remedy, "instep calibrate");
  settings.cameras = {camera("only", true)};  // its tilt and its height are found
  const auto alone = check_calibration(settings, {});
  ASSERT_TRUE(alone);
  EXPECT_FALSE(alone->good);
}

TEST(CalibrationCheck, IsBadForCamerasThatTheCalibrationLeftOut) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left"}, {"right"});
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, AllOf(HasSubstr("/etc/c.toml"), HasSubstr("right")));
  EXPECT_EQ(check->remedy, "instep calibrate");
}

TEST(CalibrationCheck, IsBadWhereAnotherUnitThanTheCalibratedOneAnswers) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left", "right"}, {});
  settings.calibration->serials = {{"left", "111"}, {"right", "222"}};
  EXPECT_TRUE(check_calibration(settings, {{"left", "111"}, {"right", ""}})->good);
  const auto check = check_calibration(settings, {{"left", "111"}, {"right", "333"}});
  ASSERT_TRUE(check);
  EXPECT_FALSE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("right is the unit 333, and 222 was calibrated"));
  EXPECT_EQ(check->remedy, "instep calibrate");
}

TEST(CalibrationCheck, SaysWhenAllWereCalibrated) {
  Settings settings;
  settings.cameras = {camera("left", false), camera("right", false)};
  settings.calibration = calibration_of({"left", "right"}, {});
  const auto check = check_calibration(settings, {});
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->good);
  EXPECT_THAT(check->finding, HasSubstr("2026-11-28T02:11:12Z"));
}

}  // namespace
}  // namespace instep
