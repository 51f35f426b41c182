#include "config/poses/tape_measured_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "config/settings_file.h"

namespace instep {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

/// One right of the middle of the image, two below it, 300 away: in the station frame.
Vector3d seen_by(const TapeMeasuredPose& measured) {
  return station_from_camera(measured) * Vector3d(1.0, 2.0, 300.0);
}

constexpr double kClose = 1e-9;

TEST(TapeMeasuredPose, OfACameraInFrontOfTheToesHasTheCustomersLeftAtItsRight) {
  // It looks along -x, so that +y is at its right hand, and z is up in its image.
  const TapeMeasuredPose front{{500, 0, 60}, {0, 0, 60}, 0.0};
  EXPECT_TRUE(seen_by(front).isApprox(Vector3d(200, 1, 58), kClose)) << seen_by(front);
}

TEST(TapeMeasuredPose, StraightDownHasXAtTheTopOfTheImage) {
  const TapeMeasuredPose above{{100, 50, 900}, {100, 50, 0}, 0.0};
  EXPECT_TRUE(seen_by(above).isApprox(Vector3d(98, 49, 600), kClose)) << seen_by(above);
}

TEST(TapeMeasuredPose, StraightUpHasXAtTheTopOfTheImage) {
  const TapeMeasuredPose below{{0, 0, -400}, {0, 0, 0}, 0.0};
  EXPECT_TRUE(seen_by(below).isApprox(Vector3d(-2, 1, -100), kClose)) << seen_by(below);
}

TEST(TapeMeasuredPose, IsStraightDownWithinATenthOfADegreeAndUprightBeyond) {
  const auto right_of = [](double aside_mm) {
    return Vector3d(station_from_camera({{0, 0, 1000}, {0, aside_mm, 0}, 0.0}).linear().col(0));
  };
  EXPECT_TRUE(right_of(1.7).isApprox(Vector3d(0, -1, 0), 2e-3)) << right_of(1.7);
  // It leans towards +y, which is at the top of an upright image, so that +x is at the right.
  EXPECT_TRUE(right_of(1.8).isApprox(Vector3d(1, 0, 0), kClose)) << right_of(1.8);
}

TEST(TapeMeasuredPose, RolledByHalfATurnHangsUpsideDown) {
  for (const double roll_deg : {180.0, -180.0}) {
    const TapeMeasuredPose hanging{{500, 0, 60}, {0, 0, 60}, roll_deg};
    EXPECT_TRUE(seen_by(hanging).isApprox(Vector3d(200, -1, 62), kClose)) << seen_by(hanging);
  }
}

TEST(TapeMeasuredPose, RollsClockwiseAsTheCameraLooks) {
  // A quarter of a turn brings its right side down and its lower side to the left, which is -y.
  const TapeMeasuredPose rolled{{500, 0, 60}, {0, 0, 60}, 90.0};
  EXPECT_TRUE(seen_by(rolled).isApprox(Vector3d(200, -2, 59), kClose)) << seen_by(rolled);
}

std::string camera_with(const std::string& keys) {
  return "[[camera]]\nkind = \"openni2\"\nname = \"left\"\n" + keys;
}

constexpr const char* kMatrix =
    "station_from_camera = [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]\n";
constexpr const char* kPlaces = "stands_at_mm = [500, 0, 60]\nlooks_at_mm = [0, 0, 60]\n";

TEST(TapeMeasuredPose, IsReadInPlaceOfAMatrixAndIsRough) {
  const auto reading = read_settings(camera_with(kPlaces + std::string("roll_deg = 180\n")), "s");
  ASSERT_TRUE(reading.good()) << reading.faults.front();
  const CameraPlacement& placement = reading.settings.cameras.front().openni.placement;
  EXPECT_TRUE((placement.station_from_camera * Vector3d(1, 2, 300))
                  .isApprox(Vector3d(200, -1, 62), kClose));
  EXPECT_TRUE(placement.is_rough);
  EXPECT_FALSE(
      read_settings(camera_with(kMatrix), "s").settings.cameras.front().openni.placement.is_rough);
}

struct PoseFault {
  std::string keys;
  const char* text;
};

void PrintTo(const PoseFault& fault, std::ostream* out) {
  *out << fault.text;
}

class TapeMeasuredPoseFault : public testing::TestWithParam<PoseFault> {};

TEST_P(TapeMeasuredPoseFault, IsReportedOnceWithItsLine) {
  EXPECT_THAT(read_settings(camera_with(GetParam().keys), "/etc/s.toml").faults,
              ElementsAre(HasSubstr(GetParam().text)));
}

INSTANTIATE_TEST_SUITE_P(
    All, TapeMeasuredPoseFault,
    testing::Values(
        PoseFault{"", "s.toml:1: camera.station_from_camera is missing: where the camera stands"},
        PoseFault{"", "or, for a camera that is to be calibrated, roughly as stands_at_mm"},
        PoseFault{std::string(kMatrix) + kPlaces,
                  "s.toml:1: camera.station_from_camera says where"},
        PoseFault{std::string(kMatrix) + "roll_deg = 0\nstands_at_mm = [1, 2, 300]\n"
                                         "looks_at_mm = [0, 0, 0]\n",
                  "or roll_deg say it again: keep one of the two"},
        PoseFault{"stands_at_mm = [1, 2, 3]", "s.toml:1: camera.looks_at_mm is missing"},
        PoseFault{"looks_at_mm = [1, 2, 3]", "s.toml:1: camera.stands_at_mm is missing"},
        PoseFault{"looks_at_mm = [1, 2, 3]\nstands_at_mm = [1, 2]",
                  "s.toml:5: camera.stands_at_mm must be a list of 3 numbers"},
        PoseFault{"looks_at_mm = [1, 2, 3]\nstands_at_mm = [1, 2, 52.9]",
                  "s.toml:1: camera.stands_at_mm and looks_at_mm are less than 50 mm apart"},
        PoseFault{"stands_at_mm = [0.5, 0.5, 0.6]\nlooks_at_mm = [0, 0, 0.05]",
                  "middle of its image: write millimetres"},
        PoseFault{"looks_at_mm = [1, 2, 3]\nstands_at_mm = [1, 2, 100001]",
                  "s.toml:5: camera.stands_at_mm is more than 100 m away"},
        PoseFault{"looks_at_mm = [1, -100001, 3]\nstands_at_mm = [1, 2, 3]",
                  "s.toml:4: camera.looks_at_mm is more than 100 m away"},
        PoseFault{kPlaces + std::string("roll_deg = 361"),
                  "s.toml:6: camera.roll_deg = 361 is outside -360 to 360"},
        PoseFault{kPlaces + std::string("roll_dge = 3"), "did you mean camera.roll_deg?"}));

}  // namespace
}  // namespace instep
