#include "daemon/command_line/recordings/calibration_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace instep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string said_of(PosesUse use, bool is_written) {
  CalibrationReport report;
  report.use = use;
  if (is_written) report.file = "/srv/poses.toml";
  return to_text(report);
}

TEST(CalibrationReport, SaysWhatComesOfThePoses) {
  EXPECT_THAT(said_of(PosesUse::kOfStation, true),
              AllOf(HasSubstr("written to /srv/poses.toml"), HasSubstr("restart instepd")));
  EXPECT_THAT(said_of(PosesUse::kInFile, true),
              AllOf(HasSubstr("written to /srv/poses.toml\n"), Not(HasSubstr("instepd"))));
  EXPECT_THAT(said_of(PosesUse::kPrinted, false), HasSubstr("--out FILE"));
  EXPECT_THAT(said_of(PosesUse::kNeedless, false),
              AllOf(HasSubstr("nothing is written"), Not(HasSubstr("--out"))));
  EXPECT_THAT(said_of(PosesUse::kNotWritten, false),
              AllOf(HasSubstr("nothing is written"), Not(HasSubstr("--out"))));
}

/// Two cameras, of which one is known; figures that tell themselves apart.
CalibrationReport two_cameras() {
  CalibrationReport report;
  report.names = {"left", "a long name"};
  report.poses.cameras.resize(2);
  auto& left = report.poses.cameras[0];
  left.station_from_camera.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  left.station_from_camera.translation() << 10, 20, 30;
  left.moved_mm = 12.34;
  left.turned_deg = 5.67;
  left.known_to_mm = 0.089;
  left.overlap = 0.456;
  left.apart_mm = 0.211;
  report.poses.cameras[1].is_level = false;
  report.poses.unexplained_mm = 0.125;
  report.poses.warnings = {"it moved"};
  return report;
}

TEST(CalibrationReport, GivesEveryFigureOfEveryCameraToPrograms) {
  auto report = two_cameras();
  const auto json = to_json(report);
  EXPECT_TRUE(json.at("file").is_null());
  EXPECT_EQ(json.at("unexplained_mm"), 0.125);
  EXPECT_EQ(json.at("warnings"), nlohmann::ordered_json({"it moved"}));
  ASSERT_EQ(json.at("cameras").size(), 2U);
  const auto& left = json["cameras"][0];
  EXPECT_EQ(left.at("name"), "left");
  EXPECT_EQ(left.at("station_from_camera"),
            nlohmann::ordered_json({0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1}));
  EXPECT_NEAR(left.at("moved_mm"), 12.34, 5e-3);
  EXPECT_NEAR(left.at("turned_deg"), 5.67, 5e-3);
  EXPECT_NEAR(left.at("u95_mm"), 0.089, 5e-4);
  EXPECT_NEAR(left.at("overlap"), 0.456, 5e-4);
  EXPECT_NEAR(left.at("apart_mm"), 0.211, 5e-4);
  EXPECT_EQ(left.at("sees_platform"), true);
  EXPECT_TRUE(json["cameras"][1].at("u95_mm").is_null());
  EXPECT_EQ(json["cameras"][1].at("sees_platform"), false);
  report.file = "/srv/poses.toml";
  EXPECT_EQ(to_json(report).at("file"), "/srv/poses.toml");
}

TEST(CalibrationReport, IsATableForPeople) {
  EXPECT_THAT(to_text(two_cameras()),
              AllOf(testing::StartsWith(
                        "camera            moved     turned    within    shares       apart\n"
                        "left            12.3 mm    5.7 deg   0.09 mm      46 %     0.21 mm\n"
                        "a long name      0.0 mm    0.0 deg         -       0 %     0.00 mm\n"),
                    HasSubstr("\nwarning: it moved\n")));
}

}  // namespace
}  // namespace instep
