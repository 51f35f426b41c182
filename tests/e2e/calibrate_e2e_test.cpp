#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "config/calibration/calibration_file.h"
#include "core/geometry/pose_rows.h"
#include "tests/support/background_program.h"
#include "tests/support/openni_station.h"
#include "tests/support/run_program.h"
#include "tests/support/station_process.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

RigidTransform pose_of(const json& numbers) {
  return RigidTransform(matrix_from_rows(numbers));
}

/// How far two cameras put a place of a foot apart, mm, by these poses instead of the true ones.
double apart(const RigidTransform& one, const RigidTransform& true_one, const RigidTransform& other,
             const RigidTransform& true_other) {
  double most = 0.0;
  for (const double x : {-110.0, 110.0}) {
    for (const double y : {-40.0, 40.0}) {
      for (const double z : {0.0, 60.0}) {
        const Eigen::Vector3d place(x, y, z);
        most = std::max(
            most, (one * true_one.inverse() * place - other * true_other.inverse() * place).norm());
      }
    }
  }
  return most;
}

/// Writes poses into a recording that are far off; returns those that were there.
std::map<std::string, RigidTransform> spoil_poses(const fs::path& recording) {
  std::map<std::string, RigidTransform> truth;
  json content = json::parse(text_of(recording / "recording.json"));
  double degrees = 15.0;
  for (auto& camera : content.at("cameras")) {
    RigidTransform pose = pose_of(camera.at("station_from_camera"));
    truth[camera.at("id")] = pose;
    pose.linear() = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0,
                                      Eigen::Vector3d(0.3, -0.5, 0.8).normalized())
                        .toRotationMatrix() *
                    pose.linear();
    pose.translation() += Eigen::Vector3d(-4.0, 5.0, 2.0) * degrees;
    camera["station_from_camera"] = pose_rows(pose);
    degrees = -degrees + 5.0;
  }
  std::ofstream(recording / "recording.json") << content.dump();
  return truth;
}

TEST(Calibrate, FindsTheCamerasOfARecordingWhosePosesAreFarOff) {
  const TemporaryFolder folder;
  const auto visit = folder.path() / "visit";
  ASSERT_EQ(run_program("instep", {"simulate", "--out", visit, "--subject", "last"}).exit_code, 0);
  const auto truth = spoil_poses(visit);
  const auto kept = folder.path() / "poses.toml";
  const auto run = run_program("instep", {"calibrate", visit, "--out", kept});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");

  const json report = json::parse(run.output);
  EXPECT_EQ(report.at("file"), kept.string());
  EXPECT_TRUE(report.at("warnings").empty());
  const auto read = read_calibration(text_of(kept), kept);
  ASSERT_TRUE(read) << read.error().line();
  ASSERT_EQ(read->cameras.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& camera = read->cameras[i];
    const auto& first = read->cameras.front();
    EXPECT_EQ(report.at("cameras").at(i).at("name"), camera.name);
    EXPECT_EQ(pose_of(report.at("cameras").at(i).at("station_from_camera")).matrix(),
              camera.station_from_camera.matrix());
    EXPECT_LT(apart(camera.station_from_camera, truth.at(camera.name), first.station_from_camera,
                    truth.at(first.name)),
              1.0);
    EXPECT_GT(report.at("cameras").at(i).at("moved_mm").get<double>(), 10.0);
  }
}

TEST(Calibrate, RefusesWhatTellsNothingAndKeepsWhatWasThere) {
  const TemporaryFolder folder;
  const auto visit = folder.path() / "visit";
  ASSERT_EQ(run_program("instep", {"simulate", "--out", visit, "--subject", "cylinder"}).exit_code,
            0);
  const auto kept = folder.path() / "poses.toml";
  const std::string before =
      calibration_toml({"2026-11-28T02:11:12Z", {{"left", RigidTransform::Identity()}}});
  std::ofstream(kept) << before;
  const auto run = run_program("instep", {"calibrate", visit, "--out", kept});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(run.errors, HasSubstr("too round"));
  EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1);
  EXPECT_EQ(text_of(kept), before);
}

TEST(Calibrate, ReplacesNoFileOfSomethingElseAndSaysSoAtOnce) {
  const TemporaryFolder folder;
  const auto refuses = [&](const fs::path& out, const std::string& why) {
    // There is no such recording, which nobody has looked for yet.
    const auto run = run_program("instep", {"calibrate", folder.path() / "none", "--out", out});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.errors, AllOf(HasSubstr(why), HasSubstr("choose another --out"))) << out;
  };
  const auto other = folder.path() / "instep.toml";
  std::ofstream(other) << "[[camera]]\nkind = \"simulated\"\n";
  refuses(other, "holds something else than a calibration");
  refuses(folder.path(), "is no regular file");
  refuses("/dev/null", "is no regular file");
  const auto link = folder.path() / "link";
  fs::create_symlink(other, link);
  refuses(link, "is no regular file");
  refuses(folder.path() / "missing/poses.toml", "is no folder");
  refuses(other / "poses.toml", "is no folder");
  EXPECT_THAT(text_of(other), HasSubstr("simulated"));
  EXPECT_EQ(run_program("instep", {"calibrate", folder.path() / "none", "--out", ""}).exit_code, 2);
}

TEST(Calibrate, LosesNoPosesThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto visit = folder.path() / "visit";
  ASSERT_EQ(run_program("instep", {"simulate", "--out", visit, "--subject", "last"}).exit_code, 0);
  // A name that the file's own temporary one is too long for.
  const auto run =
      run_program("instep", {"calibrate", visit, "--out", folder.path() / std::string(252, 'p')});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(std::count(run.errors.begin(), run.errors.end(), '\n'), 1) << run.errors;
  const json report = json::parse(run.output);
  EXPECT_TRUE(report.at("file").is_null());
  EXPECT_EQ(report.at("cameras").size(), 4U);
}

TEST(Calibrate, StoppedSaysSoInOneLineAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  const auto temporary = folder.path() / "temporary";
  fs::create_directory(temporary);
  const auto settings = folder.path() / "instep.toml";
  std::ofstream(settings) << StationProcess::small_settings() << "subject = \"last\"\n";
  ::setenv("TMPDIR", temporary.c_str(), 1);
  BackgroundProgram calibration("instep", {"calibrate", "--config", settings},
                                folder.path() / "errors");
  ::unsetenv("TMPDIR");
  for (int i = 0; i < 2000 && fs::is_empty(temporary); ++i) std::this_thread::sleep_for(1ms);
  ASSERT_FALSE(fs::is_empty(temporary)) << calibration.errors();
  calibration.signal(SIGINT);
  const int status = calibration.wait_for_end();
  ASSERT_TRUE(WIFEXITED(status)) << status;
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(calibration.errors(),
            "instep: the calibration was stopped, nothing was written: calibrate again when you "
            "are ready\n");
  EXPECT_TRUE(fs::is_empty(temporary));
}

TEST(Calibrate, RefusesRealCamerasBesideSimulatedOnes) {
  const TemporaryFolder folder;
  const auto settings = folder.path() / "instep.toml";
  std::ofstream(settings) << "[[camera]]\nkind = \"simulated\"\n"
                             "[[camera]]\nkind = \"openni2\"\nname = \"left\"\n"
                             "stands_at_mm = [500, 0, 60]\nlooks_at_mm = [0, 0, 60]\n";
  const auto run = run_program("instep", {"calibrate", "--config", settings});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.errors, HasSubstr("calibrate the real ones alone"));
}

TEST(Calibrate, OfASimulatedStationWritesNothing) {
  const TemporaryFolder folder;
  const auto settings = folder.path() / "instep.toml";
  std::ofstream(settings) << StationProcess::small_settings() << "subject = \"last\"\n";
  const auto run = run_program("instep", {"calibrate", "--config", settings});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_TRUE(json::parse(run.output).at("file").is_null());
  EXPECT_FALSE(fs::exists(folder.path() / kCalibrationFileName));
}

/// Starts it and scans once; null if nothing came of that.
json result_of_a_scan(StationProcess& station) {
  station.start();
  const auto ready = station.run_instep("status --wait-ready 60");
  EXPECT_EQ(ready.exit_code, 0) << ready.text << station.log();
  EXPECT_EQ(station.run_instep("scan").exit_code, 0) << station.log();
  const auto exported = station.folder() / "exported";
  EXPECT_EQ(station.run_instep("export latest --out " + exported.string()).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(exported)) {
    if (entry.path().filename() == "result.json") return json::parse(text_of(entry.path()));
  }
  return nullptr;
}

/// A station of sensors whose places are known by a tape measure alone.
struct TapedStation {
  explicit TapedStation(double off_mm) : sensors(bus, subject(), 18) {
    station.write_settings(sensors.camera_tables_by_tape(off_mm) +
                           "[station]\nplatform_height_mm = 0\n");
  }
  static SimulationSettings subject() {
    SimulationSettings settings;
    settings.seed = 2;
    return settings;
  }

  OpenniBus bus;
  OpenniStation sensors;
  StationProcess station;
};

TEST(Calibrate, MakesAStationOfSensorsPlacedByATape) {
  TapedStation taped(60.0);
  auto& [bus, sensors, station] = taped;
  const auto calibrated = station.run_instep("calibrate --format text");
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.text;
  const auto kept = station.folder() / kCalibrationFileName;
  EXPECT_THAT(calibrated.text, HasSubstr("written to " + kept.string()));
  const auto read = read_calibration(text_of(kept), kept);
  ASSERT_TRUE(read) << read.error().line();
  for (std::size_t i = 1; i < sensors.size(); ++i) {
    EXPECT_LT(apart(read->cameras[i].station_from_camera, sensors.station_from_camera(i),
                    read->cameras[0].station_from_camera, sensors.station_from_camera(0)),
              1.0);
  }

  const json result = result_of_a_scan(station);
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result.at("calibration"), "instep calibrate, " + read->time);
  const auto truth = subjects_truth(sensors.scene());
  ASSERT_TRUE(truth) << truth.error().line();
  int compared = 0;
  for (const json& measure : result.at("measures")) {
    for (const char* id : {"foot_length", "ball_girth", "waist_girth"}) {
      if (measure.at("id") != id) continue;
      EXPECT_NEAR(measure.at("value_mm").get<double>(), truth->front().measures.at(id), 1.0) << id;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 3);

  EXPECT_EQ(read->platform_height_mm, 0.0);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    EXPECT_EQ(read->cameras[i].serial, sensors.serial(i));
  }
  EXPECT_THAT(result.at("warnings").dump(), Not(HasSubstr("calibrate")));
  EXPECT_THAT(station.run_instep("doctor").text, Not(HasSubstr("of another station")));
  station.write_settings(sensors.camera_tables_by_tape(62.0) +
                         "[station]\nplatform_height_mm = 3\n");
  EXPECT_THAT(
      station.run_instep("doctor").text,
      AllOf(HasSubstr("of another station"), HasSubstr(sensors.name(0) + " stands elsewhere"),
            HasSubstr("platform_height_mm is 3, and was 0")));
  station.signal(SIGTERM);
  EXPECT_EQ(station.wait_for_exit(60s), 0);
}

TEST(Calibrate, IsWhatAStationAsksForWhoseSensorsATapePlaced) {
  TapedStation taped(1.0);
  auto& [bus, sensors, station] = taped;
  const json result = result_of_a_scan(station);
  ASSERT_TRUE(result.is_object());
  EXPECT_THAT(station.log(), AllOf(HasSubstr("placed by tape measure alone"),
                                   HasSubstr(sensors.name(0)), HasSubstr("instep calibrate")));
  EXPECT_EQ(result.at("calibration"), "by tape measure");
  EXPECT_THAT(result.at("warnings").dump(), HasSubstr("placed by tape measure alone"));
  station.signal(SIGTERM);
  EXPECT_EQ(station.wait_for_exit(60s), 0);
}

}  // namespace
}  // namespace instep::test
