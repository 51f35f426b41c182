#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "config/calibration/calibration_file.h"
#include "config/reading/settings_text.h"
#include "config/settings_description.h"
#include "config/settings_file.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string real_camera(const std::string& name) {
  return "[[camera]]\nkind = \"openni2\"\nserial = \"" + name + "\"\nname = \"" + name +
         "\"\nstands_at_mm = [500, 0, 60]\nlooks_at_mm = [0, 0, 60]\n";
}

constexpr const char* kVideoCamera =
    "[[camera]]\nkind = \"v4l2\"\nserial = \"1\"\nname = \"video\"\ndepth_unit_mm = 1\n"
    "intrinsics = { width = 640, height = 480, fx = 383, fy = 383, cx = 319, cy = 239 }\n"
    "station_from_camera = [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]\n";

/// A camera that the calibration puts `height_mm` above the station's origin.
CalibratedCamera calibrated(const std::string& name, double height_mm) {
  CalibratedCamera camera{name, RigidTransform::Identity()};
  camera.station_from_camera.translation().z() = height_mm;
  return camera;
}

/// A folder with settings, and with a calibration where a test writes one.
class CalibrationBesideSettings : public testing::Test {
 protected:
  void write_settings(const std::string& cameras) { std::ofstream(settings_file()) << cameras; }
  void write_calibration(const std::string& text) { std::ofstream(calibration_file()) << text; }
  void calibrate(const std::vector<CalibratedCamera>& cameras) {
    write_calibration(calibration_toml({"2026-11-28T02:11:12Z", cameras}));
  }

  std::filesystem::path settings_file() const { return folder_.path() / "own.toml"; }
  std::filesystem::path calibration_file() const { return folder_.path() / "calibration.toml"; }

  static double height_mm(const Settings& settings, std::size_t camera) {
    return settings.cameras[camera].placement()->station_from_camera.translation().z();
  }

  void fails_with(ErrorCode code, const std::string& advice) const {
    const auto settings = load_settings(settings_file());
    ASSERT_FALSE(settings);
    EXPECT_EQ(settings.error().code, code);
    EXPECT_THAT(settings.error().message, HasSubstr(calibration_file().string()));
    EXPECT_THAT(settings.error().advice,
                AllOf(HasSubstr(advice), HasSubstr("delete it and run instep calibrate again")));
    EXPECT_TRUE(load_uncalibrated_settings(settings_file())) << "to be calibrated anew";
  }

  test::TemporaryFolder folder_;
};

TEST_F(CalibrationBesideSettings, LeavesThemAloneWhereThereIsNone) {
  write_settings(real_camera("left"));
  const auto settings = load_settings(settings_file());
  ASSERT_TRUE(settings) << settings.error().line();
  EXPECT_FALSE(settings->calibration);
  EXPECT_EQ(height_mm(*settings, 0), 60.0);
  EXPECT_THAT(describe(*settings), Not(HasSubstr("poses")));
}

TEST_F(CalibrationBesideSettings, PlacesEveryCameraThatItNames) {
  write_settings(real_camera("left") + kVideoCamera);
  calibrate({calibrated("video", 800.0), calibrated("left", 700.0)});
  const auto settings = load_settings(settings_file());
  ASSERT_TRUE(settings) << settings.error().line();
  EXPECT_EQ(height_mm(*settings, 0), 700.0);
  EXPECT_EQ(height_mm(*settings, 1), 800.0);
  EXPECT_FALSE(settings->cameras[0].placement()->is_rough);
  ASSERT_TRUE(settings->calibration);
  EXPECT_EQ(settings->calibration->file, calibration_file());
  EXPECT_EQ(settings->calibration->time, "2026-11-28T02:11:12Z");
  EXPECT_THAT(settings->calibration->placed, ElementsAre("left", "video"));
  EXPECT_THAT(settings->calibration->left_out, IsEmpty());
  EXPECT_THAT(settings->calibration->unknown, IsEmpty());
  EXPECT_EQ(height_mm(*load_uncalibrated_settings(settings_file()), 0), 60.0);
}

TEST_F(CalibrationBesideSettings, NamesCamerasThatOnlyOneOfTheTwoHas) {
  write_settings(real_camera("left") + real_camera("right") + "[[camera]]\nkind = \"simulated\"\n");
  calibrate({calibrated("top", 800.0), calibrated("left", 700.0)});
  const auto settings = load_settings(settings_file());
  ASSERT_TRUE(settings) << settings.error().line();
  EXPECT_THAT(settings->calibration->placed, ElementsAre("left"));
  EXPECT_THAT(settings->calibration->left_out, ElementsAre("right"));
  EXPECT_THAT(settings->calibration->unknown, ElementsAre("top"));
  EXPECT_EQ(height_mm(*settings, 1), 60.0) << "as the settings say";
  EXPECT_TRUE(settings->cameras[1].placement()->is_rough);
  EXPECT_THAT(describe(*settings),
              AllOf(HasSubstr("lens as the sensor says\ncameras  right"),
                    HasSubstr("lens as the sensor says, placed by tape measure\n"),
                    HasSubstr("poses    left as calibrated at 2026-11-28T02:11:12Z, "),
                    HasSubstr("poses    right as the settings say"),
                    HasSubstr("poses    of top are calibrated too")));
}

/// The camera, found from where the settings have it, as the unit of that serial number.
CalibratedCamera found_from_settings(const std::string& name, const std::string& serial) {
  auto camera = calibrated(name, 700.0);
  camera.serial = serial;
  camera.began_from = RigidTransform::Identity();
  // As stands_at_mm and looks_at_mm of real_camera() have it: to -x, upright.
  camera.began_from->linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  camera.began_from->translation() << 500, 0, 60;
  return camera;
}

TEST_F(CalibrationBesideSettings, IsUsedAndToldOfWhereTheSettingsHaveChangedSince) {
  write_settings(real_camera("left"));
  const auto loaded_with = [&](const CalibratedCamera& camera) {
    write_calibration(calibration_toml({"2026-11-28T02:11:12Z", {camera}, 0.0}));
    auto settings = load_settings(settings_file());
    EXPECT_TRUE(settings) << settings.error().line();
    EXPECT_EQ(height_mm(*settings, 0), 700.0) << "used in any case";
    return describe(*settings);
  };
  auto camera = found_from_settings("left", "left");
  EXPECT_THAT(loaded_with(camera), Not(HasSubstr("calibrate again")));
  camera.began_from->translation().y() += 1e-9;  // rounding
  EXPECT_THAT(loaded_with(camera), Not(HasSubstr("calibrate again")));
  camera.began_from->translation().y() += 0.01;
  EXPECT_THAT(loaded_with(camera),
              HasSubstr("poses    left stands elsewhere by the settings than when it was "
                        "calibrated: run instep calibrate again\n"));
  camera = found_from_settings("left", "left");
  camera.began_from->rotate(Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitZ()));
  EXPECT_THAT(loaded_with(camera), HasSubstr("left stands elsewhere"));
  EXPECT_THAT(loaded_with(found_from_settings("left", "other")),
              HasSubstr("poses    left is the unit left, and other was calibrated"));
  write_settings(real_camera("left") + "[station]\nplatform_height_mm = 8\n");
  EXPECT_THAT(loaded_with(found_from_settings("left", "left")),
              HasSubstr("poses    station.platform_height_mm is 8, and was 0 when"));
}

TEST_F(CalibrationBesideSettings, IsNotForSimulatedCameras) {
  write_settings("[[camera]]\nkind = \"simulated\"\n");
  calibrate({calibrated("left", 700.0)});
  const auto settings = load_settings(settings_file());
  ASSERT_TRUE(settings) << settings.error().line();
  EXPECT_THAT(settings->calibration->unknown, ElementsAre("left"));
  EXPECT_THAT(describe(*settings),
              AllOf(HasSubstr("poses    simulated and recorded cameras bring their own; " +
                              calibration_file().string() + " is not used\n"),
                    Not(HasSubstr("is called so"))));
}

TEST_F(CalibrationBesideSettings, FailsTheLoadWhereItIsFaulty) {
  write_settings(real_camera("left"));
  write_calibration("calibrated_at = \"2026-11-28T02:11:12Z\"\n[[camera]]\nname = \"left\"\n");
  fails_with(ErrorCode::kInvalidInput, "mend it");
  EXPECT_THAT(load_settings(settings_file()).error().message, HasSubstr("calibration.toml:2: "));
}

/// Runs the program in a folder that is gone.
class GoneFolder {
 public:
  GoneFolder() : before_(std::filesystem::current_path()) {
    const test::TemporaryFolder folder;
    std::filesystem::current_path(folder.path());
  }
  ~GoneFolder() { std::filesystem::current_path(before_); }
  GoneFolder(const GoneFolder&) = delete;
  GoneFolder& operator=(const GoneFolder&) = delete;

 private:
  std::filesystem::path before_;
};

TEST(CalibrationBeside, ThrowsNothingWhereTheProgramsFolderIsGone) {
  EXPECT_EQ(calibration_beside("/etc/instep/own.toml"), "/etc/instep/calibration.toml");
  const GoneFolder gone;
  EXPECT_EQ(calibration_beside("own.toml"), "calibration.toml");
}

TEST(SettingsText, ThatCannotBeReadToItsEndIsNoShortText) {
  const test::TemporaryFolder folder;
  const auto text = read_settings_text(folder.path(), "calibration file");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::kIo);
}

TEST_F(CalibrationBesideSettings, FailsTheLoadWhereItCannotBeRead) {
  write_settings(real_camera("left"));
  write_calibration(std::string(kLargestSettingsFile + 1, '#'));
  fails_with(ErrorCode::kInvalidInput, "check that it is a calibration file");
  std::filesystem::remove(calibration_file());
  for (const char* lost : {"nowhere", "calibration.toml"}) {
    std::filesystem::create_symlink(lost, calibration_file());
    fails_with(ErrorCode::kNotFound, "delete it");
    EXPECT_THAT(load_settings(settings_file()).error().line(),
                AllOf(HasSubstr("a link that leads nowhere"), Not(HasSubstr("let the user"))));
    std::filesystem::remove(calibration_file());
  }
  std::filesystem::create_directory(calibration_file());
  fails_with(ErrorCode::kInvalidInput, "see what it is");
  std::filesystem::remove(calibration_file());
  ASSERT_EQ(::mkfifo(calibration_file().c_str(), 0600), 0);
  fails_with(ErrorCode::kInvalidInput, "see what it is");  // and does not wait for a writer
}

}  // namespace
}  // namespace instep
