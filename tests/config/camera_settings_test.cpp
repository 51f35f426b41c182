#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "config/settings_description.h"
#include "config/settings_file.h"

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kPose =
    "station_from_camera = [0, 1, 0, 10,  1, 0, 0, 20,  0, 0, -1, 500,  0, 0, 0, 1]\n";

std::string camera_table(const std::string& keys) {
  return "[[camera]]\nkind = \"openni2\"\n" + keys;
}

TEST(CameraSettings, HoldWhatIsSaidOfAnOpenniSensor) {
  const auto reading = read_settings(
      camera_table("serial = \"A1\"\nname = \"left\"\nlibrary_folder = \"maker\"\n" +
                   std::string(kPose) +
                   "[camera.intrinsics]\nwidth = 320\nheight = 240\nfx = 290\nfy = 291\n"
                   "cx = 160.5\ncy = 118\ndistortion = [0.1, -0.05, 0, 0.001, 0]\n"),
      "/etc/s.toml");
  ASSERT_TRUE(reading.good()) << reading.faults.front();
  const OpenniSettings& camera = reading.settings.cameras.front().openni;
  EXPECT_EQ(reading.settings.cameras.front().kind, CameraKind::kOpenni);
  EXPECT_EQ(camera.serial, "A1");
  EXPECT_EQ(camera.library_folder, "/etc/maker");
  EXPECT_EQ(camera.placement.name, "left");
  const Eigen::Vector3d seen(1.0, 2.0, 300.0);
  EXPECT_TRUE((camera.placement.station_from_camera * seen)
                  .isApprox(Eigen::Vector3d(12.0, 21.0, 200.0), 1e-12));
  ASSERT_TRUE(camera.placement.intrinsics);
  EXPECT_EQ(camera.placement.intrinsics->fy, 291.0);
  EXPECT_EQ(camera.placement.intrinsics->distortion[3], 0.001);
  EXPECT_THAT(describe(reading.settings), HasSubstr("left, the OpenNI2 sensor A1"));
}

TEST(CameraSettings, NeedNeitherSerialNorIntrinsics) {
  const auto reading = read_settings(camera_table("name = \"left\"\n" + std::string(kPose)), "s");
  ASSERT_TRUE(reading.good()) << reading.faults.front();
  EXPECT_FALSE(reading.settings.cameras.front().openni.placement.intrinsics);
}

struct CameraFault {
  std::string toml;
  const char* text;
};

void PrintTo(const CameraFault& fault, std::ostream* out) {
  *out << fault.text;
}

class CameraSettingsFault : public testing::TestWithParam<CameraFault> {};

TEST_P(CameraSettingsFault, IsReportedOnce) {
  EXPECT_THAT(read_settings(GetParam().toml, "/etc/s.toml").faults,
              ElementsAre(HasSubstr(GetParam().text)));
}

std::string with_pose(const std::string& numbers) {
  return camera_table("name = \"left\"\nstation_from_camera = " + numbers);
}

std::string with_lens(const std::string& lens) {
  return camera_table("name = \"left\"\n" + std::string(kPose) + "intrinsics = " + lens);
}

INSTANTIATE_TEST_SUITE_P(
    All, CameraSettingsFault,
    testing::Values(
        CameraFault{camera_table(kPose), "/etc/s.toml:1: camera.name is missing"},
        CameraFault{camera_table("name = \"left\""), "camera.station_from_camera is missing"},
        CameraFault{with_pose("[1, 2, 3]"), "must be a list of 16 numbers"},
        CameraFault{with_pose("\"here\""), "must be a list of 16 numbers"},
        CameraFault{with_pose("[1,0,0,0, 0,1,0,0, 0,0,nan,0, 0,0,0,1]"), "list of 16 numbers"},
        CameraFault{with_pose("[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"), "no rotation and shift"},
        CameraFault{with_pose("[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1]"), "no rotation and shift"},
        CameraFault{with_pose("[1,0,0,2e5, 0,1,0,0, 0,0,1,0, 0,0,0,1]"), "write millimetres"},
        CameraFault{with_lens("3"), "camera.intrinsics must be written as"},
        CameraFault{with_lens("{ width = 640, height = 480, fx = 575, fy = 575, cx = 320 }"),
                    "camera.intrinsics.cy is missing"},
        CameraFault{with_lens("{ width = 640, height = 480, fx = 1, fy = 575, cx = 320, cy = 9 }"),
                    "a focal length is no number or outside"},
        CameraFault{with_lens("{ width = 640, height = 480, fx = 575, fy = 575, cx = 320, cy = 9,"
                              " distorsion = [0, 0, 0, 0, 0] }"),
                    "did you mean camera.intrinsics.distortion?"},
        CameraFault{with_lens("{ width = 640, height = 480, fx = 575, fy = 575, cx = 320, cy = 9,"
                              " distortion = [0, 0] }"),
                    "camera.intrinsics.distortion must be a list of 5 numbers"},
        CameraFault{camera_table("serail = \"A1\"\nname = \"left\"\n" + std::string(kPose)),
                    "did you mean camera.serial?"},
        CameraFault{"[[camera]]\nkind = \"simulated\"\nserial = \"A1\"",
                    "no setting camera.serial"},
        CameraFault{"[[camera]]\nkind = \"openi2\"", "did you mean \"openni2\"?"}));

}  // namespace
}  // namespace instep
