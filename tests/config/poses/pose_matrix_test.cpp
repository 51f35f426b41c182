#include "config/poses/pose_matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace instep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Reading {
  std::optional<RigidTransform> pose;
  std::vector<std::string> faults;
};

Reading read(const std::string& text) {
  const toml::table toml = toml::parse(text);
  SettingsFaults faults("s.toml");
  SettingsTable table(toml, "camera", faults);
  auto pose = read_pose_matrix(table, faults);
  table.finish();
  return {pose, faults.in_order()};
}

Reading read_matrix(const std::string& numbers) {
  return read("\nstation_from_camera = [" + numbers + "]");
}

TEST(PoseMatrix, IsReadRowByRow) {
  const auto reading = read_matrix("0, 1, 0, 10,  1, 0, 0, 20.5,  0, 0, -1, 500,  0, 0, 0, 1");
  ASSERT_TRUE(reading.pose);
  EXPECT_THAT(reading.faults, IsEmpty());
  const Eigen::Vector3d moved = *reading.pose * Eigen::Vector3d(1, 2, 3);
  EXPECT_EQ(moved, Eigen::Vector3d(12, 21.5, 497));
}

TEST(PoseMatrix, OfAllDigitsStaysAsItIs) {
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  const auto reading = read_matrix(
      "0.9553364891256060, -0.29552020666133957, 0, 1,  0.29552020666133957, 0.9553364891256060, "
      "0, 2,  0, 0, 1, 3,  0, 0, 0, 1");
  ASSERT_TRUE(reading.pose);
  EXPECT_EQ(reading.pose->linear()(0, 0), c);
  EXPECT_EQ(reading.pose->linear()(1, 0), s);
}

TEST(PoseMatrix, LosesTheRoundingOfItsDecimals) {
  const auto reading =
      read_matrix("0.955, -0.296, 0, 1,  0.296, 0.955, 0, 2,  0, 0, 1, 3,  0, 0, 0, 1");
  ASSERT_TRUE(reading.pose);
  const Eigen::Matrix3d turn = reading.pose->linear();
  EXPECT_LT((turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_NEAR(std::atan2(turn(1, 0), turn(0, 0)), std::atan2(0.296, 0.955), 1e-12);
  EXPECT_EQ(reading.pose->translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(PoseMatrix, ThatIsNoneLeavesOneFaultAtItsLine) {
  const std::string none = "s.toml:2: camera.station_from_camera is no rotation and shift";
  const std::pair<std::string, std::string> cases[] = {
      {"1, 0, 0, 0,  0, 1, 0, 0,  0, 0, -1, 0,  0, 0, 0, 1", none},   // a mirror
      {"2, 0, 0, 0,  0, 2, 0, 0,  0, 0, 2, 0,  0, 0, 0, 1", none},    // a scale
      {"1, 0.1, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1", none},  // a shear
      {"1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 500, 1", none},  // columns for rows
      {"0, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 0,  0, 0, 0, 0", none},
      {"1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0", "must be a list of 16 numbers"},
      {"1, 0, 0, nan,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1", "must be a list of 16 numbers"},
      {"1, 0, 0, inf,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1", "must be a list of 16 numbers"},
      {"1, 0, 0, \"0\",  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1", "must be a list of 16 numbers"},
      {"1, 0, 0, 0,  0, 1, 0, -100001,  0, 0, 1, 0,  0, 0, 0, 1", "more than 100 m away"}};
  for (const auto& [numbers, fault] : cases) {
    const auto reading = read_matrix(numbers);
    EXPECT_FALSE(reading.pose) << numbers;
    EXPECT_THAT(reading.faults, ElementsAre(HasSubstr(fault))) << numbers;
  }
  EXPECT_TRUE(read_matrix("1, 0, 0, 0,  0, 1, 0, -1e5,  0, 0, 1, 0,  0, 0, 0, 1").pose);
}

TEST(PoseMatrix, ThatIsNotThereIsNoFault) {
  const auto reading = read("");
  EXPECT_FALSE(reading.pose);
  EXPECT_THAT(reading.faults, IsEmpty());
}

}  // namespace
}  // namespace instep
