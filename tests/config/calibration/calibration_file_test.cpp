#include "config/calibration/calibration_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <numbers>
#include <ostream>
#include <random>
#include <string>

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kTime = "calibrated_at = \"2026-11-28T02:11:12Z\"\n";
constexpr const char* kPose =
    "station_from_camera = [0, 1, 0, 10,  1, 0, 0, 20,  0, 0, -1, 500,  0, 0, 0, 1]\n";

std::string camera(const std::string& name) {
  return "[[camera]]\nname = \"" + name + "\"\n" + kPose;
}

Result<StationCalibration> read(const std::string& toml) {
  return read_calibration(toml, "/etc/c.toml");
}

RigidTransform drawn_pose(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  RigidTransform pose = RigidTransform::Identity();
  pose.linear() = Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized().matrix();
  pose.translation() = 700.0 * Eigen::Vector3d(draw(), draw(), draw());
  return pose;
}

bool same_bits(const RigidTransform& one, const RigidTransform& other) {
  return std::memcmp(one.data(), other.data(), 16 * sizeof(double)) == 0;
}

TEST(CalibrationFile, HoldsTimeNamesAndPoses) {
  const auto calibration = read(kTime + camera("left") + camera("right"));
  ASSERT_TRUE(calibration) << calibration.error().line();
  EXPECT_EQ(calibration->time, "2026-11-28T02:11:12Z");
  ASSERT_EQ(calibration->cameras.size(), 2U);
  EXPECT_EQ(calibration->cameras[1].name, "right");
  EXPECT_TRUE((calibration->cameras[1].station_from_camera * Eigen::Vector3d(1, 2, 300))
                  .isApprox(Eigen::Vector3d(12, 21, 200), 1e-12));
}

TEST(CalibrationFile, IsWrittenForPeopleARowALine) {
  StationCalibration calibration{"2026-11-28T02:11:12Z", {{"left", RigidTransform::Identity()}}};
  calibration.cameras[0].station_from_camera.translation() << 0.5, -0.0, 1e-7;
  EXPECT_THAT(calibration_toml(calibration),
              AllOf(HasSubstr("# "), HasSubstr("delete it"),
                    HasSubstr("\n  1, 0, 0, 0.5,\n  0, 1, 0, -0.0,\n  0, 0, 1, 1e-07,\n")));
}

TEST(CalibrationFile, ReadsBackToTheSameBits) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 200; ++round) {
    StationCalibration written{"2026-11-28T02:11:12Z", {}};
    for (int i = 0; i < 4; ++i) {
      written.cameras.push_back({"camera-" + std::to_string(i), drawn_pose(random)});
    }
    written.cameras[0].station_from_camera.translation().y() = -0.0;
    const auto again = read(calibration_toml(written));
    ASSERT_TRUE(again) << again.error().line();
    for (std::size_t i = 0; i < written.cameras.size(); ++i) {
      EXPECT_TRUE(
          same_bits(again->cameras[i].station_from_camera, written.cameras[i].station_from_camera))
          << "round " << round << ", camera " << i;
    }
  }
}

/// What a file of version 2 has to say.
std::string second_version(const std::string& more_of_camera = "") {
  return "version = 2\n" + std::string(kTime) + "platform_height_mm = -1.25\n" + camera("left") +
         "began_from = [1, 0, 0, 7,  0, 1, 0, 8,  0, 0, 1, 9,  0, 0, 0, 1]\n" + more_of_camera;
}

TEST(CalibrationFile, HoldsWhatItWasFoundFrom) {
  const auto calibration = read(second_version("serial = \"0042\"\n"));
  ASSERT_TRUE(calibration) << calibration.error().line();
  EXPECT_EQ(calibration->platform_height_mm, -1.25);
  EXPECT_EQ(calibration->cameras[0].serial, "0042");
  ASSERT_TRUE(calibration->cameras[0].began_from);
  EXPECT_EQ(calibration->cameras[0].began_from->translation(), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(calibration->cameras[0].station_from_camera.translation(),
            Eigen::Vector3d(10, 20, 500));
  const auto without_serial = read(second_version());
  ASSERT_TRUE(without_serial) << without_serial.error().line();
  EXPECT_EQ(without_serial->cameras[0].serial, "") << "not every camera tells one";
}

TEST(CalibrationFile, OfTheFirstVersionSaysNothingOfThat) {
  for (const std::string version : {"", "version = 1\n"}) {
    const auto calibration = read(version + kTime + camera("left"));
    ASSERT_TRUE(calibration) << calibration.error().line();
    EXPECT_FALSE(calibration->platform_height_mm);
    EXPECT_EQ(calibration->cameras[0].serial, "");
    EXPECT_FALSE(calibration->cameras[0].began_from);
  }
}

TEST(CalibrationFile, ReadsBackWhatItWasFoundFrom) {
  std::mt19937_64 random(13);
  StationCalibration written{"2026-11-28T02:11:12Z", {}};
  written.platform_height_mm = -0.1;
  for (const std::string serial : {"", "A \"1\""}) {
    written.cameras.push_back({"camera" + serial, drawn_pose(random), serial, drawn_pose(random)});
  }
  const auto text = calibration_toml(written);
  EXPECT_THAT(text, HasSubstr("\nversion = 2\n"));
  const auto again = read(text);
  ASSERT_TRUE(again) << again.error().line();
  EXPECT_EQ(again->platform_height_mm, written.platform_height_mm);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again->cameras[i].serial, written.cameras[i].serial);
    EXPECT_TRUE(same_bits(*again->cameras[i].began_from, *written.cameras[i].began_from));
  }
}

TEST(CalibrationFile, KeepsAnyNameThatSettingsTake) {
  for (const std::string name : {"left \"2\"", "C:\\left", "l'avant", "'\"\\", "früh", "# [[x]]"}) {
    const auto again =
        read(calibration_toml({"2026-11-28T02:11:12Z", {{name, RigidTransform::Identity()}}}));
    ASSERT_TRUE(again) << again.error().line();
    EXPECT_EQ(again->cameras[0].name, name);
  }
}

TEST(CalibrationFile, TellsAllOfItsFaultsAndWhatToDo) {
  const auto calibration = read("calibrated_at = 3\n[[camera]]\nname = \"left\"\n");
  ASSERT_FALSE(calibration);
  EXPECT_EQ(calibration.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(calibration.error().message,
            "/etc/c.toml:1: calibrated_at must be text in quotes, but it is a whole number\n"
            "/etc/c.toml:2: camera.station_from_camera is missing");
  EXPECT_THAT(calibration.error().advice, HasSubstr("instep calibrate"));
}

TEST(CalibrationFile, TakesTheEdgesOfATimeAndNothingBeyond) {
  const auto takes = [](const std::string& time) {
    return read("calibrated_at = \"" + time + "\"\n" + camera("left")).has_value();
  };
  EXPECT_TRUE(takes("2026-01-01T00:00:00Z"));
  EXPECT_TRUE(takes("2026-12-31T23:59:60Z"));
  for (const char* time : {"2026-00-28T02:11:12Z", "2026-13-28T02:11:12Z", "2026-11-00T02:11:12Z",
                           "2026-11-32T02:11:12Z", "2026-11-28T24:11:12Z", "2026-11-28T02:60:12Z",
                           "2026-11-28T02:11:61Z", "9999-99-99T99:99:99Z"}) {
    EXPECT_FALSE(takes(time)) << time;
  }
}

struct Fault {
  std::string toml;
  std::string message;  ///< how it begins
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.message;
}

class CalibrationFileFault : public testing::TestWithParam<Fault> {};

TEST_P(CalibrationFileFault, IsTheOnlyOneAndHasItsLine) {
  const auto calibration = read(GetParam().toml);
  ASSERT_FALSE(calibration);
  EXPECT_THAT(calibration.error().message,
              testing::StartsWith("/etc/c.toml:" + GetParam().message));
  EXPECT_EQ(calibration.error().message.find('\n'), std::string::npos)
      << calibration.error().message;
}

std::string seventeen_cameras() {
  std::string text = kTime;
  for (int i = 0; i < 17; ++i) text += camera(std::to_string(i));
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    All, CalibrationFileFault,
    testing::Values(
        Fault{camera("left"), "1: calibrated_at must be a time such as"},
        Fault{"\ncalibrated_at = \"today\"\n" + camera("left"), "2: calibrated_at must be a time"},
        Fault{"calibrated_at = \"2026-11-28T02:11:12Z \"\n" + camera("left"),
              "1: calibrated_at must be a time"},
        Fault{"calibrated_at = 2026-11-28T02:11:12Z\n" + camera("left"),
              "1: calibrated_at must be text in quotes, but it is a date or time"},
        Fault{"calibrated_at = \"\"\n" + camera("left"), "1: calibrated_at must have 1 to 64"},
        Fault{kTime, "1: there is no [[camera]]"},
        Fault{std::string(kTime) + "camera = []\n", "2: camera must be written as [[camera]]"},
        Fault{std::string(kTime) + "camera = 3\n", "2: camera must be written as [[camera]]"},
        Fault{seventeen_cameras(), "1: there are 17 [[camera]] tables, more than 16"},
        Fault{kTime + camera("left") + camera("right") + camera("left"),
              "8: there are two cameras of the name left"},
        Fault{std::string(kTime) + "[[camera]]\n" + kPose, "2: camera.name is missing"},
        Fault{std::string(kTime) + "[[camera]]\nname = \"left\"\n",
              "2: camera.station_from_camera is missing"},
        Fault{kTime + camera("left") + "fx = 3\n", "5: there is no setting camera.fx"},
        Fault{"calibrate_at = 1\n" + (kTime + camera("left")),
              "1: there is no setting calibrate_at: did you mean calibrated_at?"},
        Fault{std::string(kTime) + "[[camera]]\nname = \"left\"\nstation_from_camera = [1, 2]\n",
              "4: camera.station_from_camera must be a list of 16 numbers"},
        Fault{std::string(kTime) + "[[camera]]\nname = \"left\"\nstation_from_camera = "
                                   "[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n",
              "4: camera.station_from_camera is no rotation and shift"},
        Fault{std::string(kTime) + "[[camera]]\nname = \"left\"\nstation_from_camera = "
                                   "[1,0,0,2e5, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n",
              "4: camera.station_from_camera puts the camera more than 100 m away"},
        Fault{kTime + camera("left") + "serial = \"1\"\n", "5: there is no setting camera.serial"},
        Fault{"platform_height_mm = 0\n" + (kTime + camera("left")),
              "1: there is no setting platform_height_mm"},
        Fault{"version = 2\nplatform_height_mm = 0\n" + (kTime + camera("left")),
              "4: camera.began_from is missing"},
        Fault{second_version("serial = 42\n"), "8: camera.serial must be text in quotes"},
        Fault{second_version("seriel = \"42\"\n"), "8: there is no setting camera.seriel"},
        // Whatever else it says is another version's concern.
        Fault{"version = 3\nrooms = 4\n", "1: version = 3 is none of 1 to 2"},
        Fault{"version = \"2\"\n" + (kTime + camera("left")),
              "1: version must be a whole number, but it is text"},
        Fault{kTime + camera("left") + "[[", "5: "}));

TEST(CalibrationFile, NeverThrowsOnDamagedText) {
  const std::string sound = kTime + camera("left") + camera("right");
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = sound;
    for (int hits = 0; hits < 3; ++hits) {
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    }
    EXPECT_NO_THROW((void)read(damaged));
  }
}

}  // namespace
}  // namespace instep
