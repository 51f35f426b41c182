#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/openni_station.h"
#include "tests/support/station_process.h"

/// The real daemon, the real instep-openni and the stock OpenNI2 library; only the sensors are not
/// there.
namespace instep::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;

constexpr auto kLong = 60000ms;

/// Three cameras with few pixels, which is enough for a result.
SimulationSettings small_station() {
  SimulationSettings settings;
  settings.cameras = 3;
  settings.width_px = 160;
  settings.height_px = 120;
  return settings;
}

constexpr const char* kSmallCapture =
    "[capture]\nframes_per_camera = 2\nwarmup_frames = 0\ncheck_every_s = 1\n";

json newest_result(const StationProcess& station) {
  const auto listed = station.run_instep("list");
  const std::string id = listed.text.substr(0, listed.text.find('\n'));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(station.store())) {
    if (entry.path().filename() != id) continue;
    std::ifstream stream(entry.path() / "result.json");
    return json::parse(stream);
  }
  return {};
}

TEST(OpenniStation, MeasuresAFootRight) {
  OpenniBus bus;
  SimulationSettings settings;
  settings.seed = 2;
  const OpenniStation sensors(bus, settings, 18);
  StationProcess station;
  station.write_settings(sensors.camera_tables() + "[station]\nplatform_height_mm = 0\n");
  station.start();
  const auto ready = station.run_instep("status --wait-ready 60");
  ASSERT_EQ(ready.exit_code, 0) << ready.text << station.log();
  const auto scan = station.run_instep("scan");
  ASSERT_EQ(scan.exit_code, 0) << scan.text << station.log();

  const json result = newest_result(station);
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result.at("simulated"));
  const auto truth = subjects_truth(sensors.scene());
  ASSERT_TRUE(truth) << truth.error().line();
  std::map<std::string, double> measured;
  for (const json& measure : result.at("measures")) {
    if (measure.contains("value_mm")) measured[measure.at("id")] = measure.at("value_mm");
  }
  for (const char* id :
       {"foot_length", "foot_breadth", "ball_girth", "waist_girth", "instep_girth"}) {
    ASSERT_TRUE(measured.contains(id)) << id;
    EXPECT_NEAR(measured.at(id), truth->front().measures.at(id), 1.0) << id;
  }
  station.signal(SIGTERM);
  EXPECT_EQ(station.wait_for_exit(kLong), 0);
}

// One camera drops out of a scan, and has to be opened again after its replug.
TEST(OpenniStation, PartialSetIsNeverFusedSilentlyAndIsWholeAgainAfterAReplug) {
  OpenniBus bus;
  OpenniStation sensors(bus, small_station(), 3);
  StationProcess station;
  station.write_settings(sensors.camera_tables() + kSmallCapture);
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  ASSERT_EQ(station.run_instep("scan").exit_code, 0) << station.log();

  bus.unplug(sensors.serial(1));
  const auto refused = station.run_instep("scan");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.text, AllOf(HasSubstr("camera " + sensors.name(1)), HasSubstr("plug")));
  // The pause between two attempts is at its longest by the time that it comes back.
  std::this_thread::sleep_for(4s);
  sensors.plug_in(1);
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  EXPECT_EQ(station.run_instep("scan").exit_code, 0) << station.log();
}

/// A station whose sensors are all away.
void start_unplugged(OpenniBus& bus, const OpenniStation& sensors, StationProcess& station) {
  for (std::size_t i = 0; i < sensors.size(); ++i) bus.unplug(sensors.serial(i));
  station.write_settings(sensors.camera_tables() + kSmallCapture);
  station.start();
}

TEST(OpenniStation, StartsWithoutItsCamerasAndSurvivesTheirCrashes) {
  OpenniBus bus;
  OpenniStation sensors(bus, small_station(), 3);
  StationProcess station;
  start_unplugged(bus, sensors, station);
  ASSERT_TRUE(station.wait_for("READY=1", kLong)) << station.log();
  ASSERT_TRUE(station.wait_for("is not plugged in", kLong)) << station.log();
  for (std::size_t i = 0; i < sensors.size(); ++i) sensors.plug_in(i);
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();

  bus.set_faults(sensors.serial(0), {"crash"});
  const auto failed = station.run_instep("scan");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.text, HasSubstr("signal 6"));
  bus.set_faults(sensors.serial(0), {});
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  // For some 50 ms, until it has looked at its cameras again, it takes itself for ready.
  if (station.run_instep("scan").exit_code == 0) return;
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  EXPECT_EQ(station.run_instep("scan").exit_code, 0) << station.log();
}

/// They were all opened and closed again every two seconds for as long as one was away.
TEST(OpenniStation, KeepsItsOtherSensorsOpenWhileOneIsMissing) {
  OpenniBus bus;
  OpenniStation sensors(bus, small_station(), 3);
  bus.unplug(sensors.serial(1));
  StationProcess station;
  station.write_settings(sensors.camera_tables() + kSmallCapture);
  station.start();
  ASSERT_TRUE(station.wait_for("is not plugged in", kLong)) << station.log();
  const auto open = child_processes(station.process());
  sensors.plug_in(1);
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  const auto all = child_processes(station.process());
  EXPECT_EQ(all.size(), sensors.size());
  EXPECT_EQ(std::count_if(
                all.begin(), all.end(),
                [&](pid_t one) { return std::find(open.begin(), open.end(), one) != open.end(); }),
            2);
}

/// What the daemon says is wrong with a camera; empty if nothing is.
std::string trouble_of(const StationProcess& station, const std::string& camera) {
  const auto status = json::parse(station.run_instep("status --format json").text);
  for (const json& trouble : status.at("troubles")) {
    const auto line = trouble.get<std::string>();
    if (line.starts_with("camera " + camera + ":")) return line;
  }
  return {};
}

/// Each that came was another camera there in place of those that had not, which were all warned of
/// once more.
TEST(OpenniStation, LogsOnceThatACameraIsMissingWhateverElseComes) {
  OpenniBus bus;
  OpenniStation sensors(bus, small_station(), 3);
  StationProcess station;
  start_unplugged(bus, sensors, station);
  ASSERT_TRUE(station.wait_for("is not plugged in", kLong)) << station.log();
  const auto& last = sensors.name(2);
  const auto first_words = trouble_of(station, last);
  ASSERT_THAT(first_words, HasSubstr(sensors.serial(2) + " is not plugged in"));
  for (std::size_t i = 0; i < 2; ++i) {
    sensors.plug_in(i);
    const auto deadline = steady_clock::now() + kLong;
    while (!trouble_of(station, sensors.name(i)).empty() && steady_clock::now() < deadline) {
      std::this_thread::sleep_for(10ms);
    }
    EXPECT_EQ(trouble_of(station, sensors.name(i)), "");
    EXPECT_THAT(trouble_of(station, last), HasSubstr(sensors.serial(2) + " is not plugged in"));
    EXPECT_NE(trouble_of(station, last), first_words) << "its newest words are told";
  }
  sensors.plug_in(2);
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string log = station.log();
    const std::string warning = sensors.serial(i) + " is not plugged in";
    const auto first = log.find(warning);
    ASSERT_NE(first, std::string::npos) << log;
    EXPECT_EQ(log.find(warning, first + 1), std::string::npos) << log;
  }
}

TEST(OpenniStation, TakesTheSetOnceMoreWhenAProcessDiesInMidScan) {
  OpenniBus bus;
  const OpenniStation sensors(bus, small_station(), 3);
  StationProcess station;
  // The capture takes two seconds, of which a busy machine may lose one before the process is
  // ended.
  station.write_settings(sensors.camera_tables() +
                         "[capture]\nframes_per_camera = 60\nwarmup_frames = 0\n"
                         "deadline_ms = 20000\n");
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong));
  const auto children = child_processes(station.process());
  ASSERT_EQ(children.size(), sensors.size());
  station.tap_pedal();
  ASSERT_TRUE(station.wait_for("STATUS=capturing", kLong)) << station.log();
  std::this_thread::sleep_for(200ms);
  ::kill(children[1], SIGKILL);
  ASSERT_TRUE(station.wait_for("STATUS=measuring", kLong)) << station.log();
  EXPECT_NE(child_processes(station.process()), children);
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  EXPECT_TRUE(newest_result(station).is_object());
}

TEST(OpenniStation, EndsAtOnceWhileASensorHangs) {
  OpenniBus bus;
  OpenniStation sensors(bus, small_station(), 3);
  bus.set_faults(sensors.serial(0), {"hang-open"});
  StationProcess station;
  station.write_settings(sensors.camera_tables() + kSmallCapture);
  station.start();
  ASSERT_TRUE(station.wait_for("READY=1", kLong)) << station.log();
  const auto deadline = steady_clock::now() + 10s;
  std::vector<pid_t> children;
  while (children.empty() && steady_clock::now() < deadline) {
    children = child_processes(station.process());
  }
  ASSERT_FALSE(children.empty());
  station.signal(SIGTERM);
  // Before the time is over that opening a sensor may take.
  EXPECT_EQ(station.wait_for_exit(5s), 0) << station.log();
}

TEST(OpenniStation, LeavesNoProcessBehindWhenItIsKilled) {
  OpenniBus bus;
  const OpenniStation sensors(bus, small_station(), 3);
  StationProcess station;
  station.write_settings(sensors.camera_tables() + kSmallCapture);
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0) << station.log();
  const auto children = child_processes(station.process());
  EXPECT_EQ(children.size(), sensors.size());
  station.signal(SIGKILL);
  ASSERT_TRUE(station.wait_for_exit(kLong));
  const auto deadline = steady_clock::now() + kLong;
  const auto alive = [&] {
    return std::any_of(children.begin(), children.end(),
                       [](pid_t child) { return runs(child, "instep-openni"); });
  };
  while (alive() && steady_clock::now() < deadline) std::this_thread::sleep_for(10ms);
  EXPECT_FALSE(alive());
}

}  // namespace
}  // namespace instep::test
