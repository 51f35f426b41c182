#include "daemon/command_line/recordings/calibration_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

StationCalibration calibration_of(const std::vector<std::string>& names) {
  StationCalibration calibration{"2026-11-28T02:11:12Z", {}};
  for (const auto& name : names) calibration.cameras.push_back({name, RigidTransform::Identity()});
  return calibration;
}

TEST(CalibrationTarget, MayReplaceACalibrationAndOfTheStationAFaultyOne) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "calibration.toml";
  EXPECT_TRUE(check_calibration_target({file, false})) << "nothing is there";
  ASSERT_TRUE(write_calibration({file, false}, calibration_of({"left"})));
  EXPECT_TRUE(check_calibration_target({file, false}));
  std::ofstream(file) << "faulty";
  EXPECT_FALSE(check_calibration_target({file, false}));
  EXPECT_TRUE(check_calibration_target({file, true}));
  fs::remove(file);
  fs::create_symlink("nowhere", file);
  EXPECT_FALSE(check_calibration_target({file, false}));
  EXPECT_TRUE(check_calibration_target({file, true}));
  ASSERT_TRUE(write_calibration({file, true}, calibration_of({"left"})));
  EXPECT_TRUE(fs::is_symlink(file));
  EXPECT_TRUE(fs::is_regular_file(folder.path() / "nowhere"));
  EXPECT_TRUE(check_calibration_target({file, true}));
  std::ofstream(folder.path() / "nowhere") << "something else";
  EXPECT_FALSE(check_calibration_target({file, true})) << "what a link leads to is not lost";
  fs::remove(file);
  fs::create_symlink("no such folder/file", file);
  EXPECT_FALSE(check_calibration_target({file, true}));
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_FALSE(check_calibration_target({file, true}));
}

TEST(CalibrationTarget, GetsNothingThatWouldNotBeReadAgain) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "calibration.toml";
  std::vector<std::string> many;
  for (std::size_t i = 0; i <= kMostCalibratedCameras; ++i) many.push_back(std::to_string(i));
  for (const auto& names : std::vector<std::vector<std::string>>{
           {""}, {std::string(65, 'c')}, {"le\nft"}, {"left", "left"}, {"\xff"}, many, {}}) {
    const auto written = write_calibration({file, false}, calibration_of(names));
    ASSERT_FALSE(written) << names.size() << " cameras";
    EXPECT_EQ(written.error().code, ErrorCode::kInvalidInput);
    EXPECT_THAT(written.error().advice, HasSubstr("leave --out away"));
    EXPECT_FALSE(fs::exists(file));
  }
}

}  // namespace
}  // namespace instep
