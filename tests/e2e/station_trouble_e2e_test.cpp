#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <chrono>
#include <fstream>

#include "tests/support/run_program.h"
#include "tests/support/station_process.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using test::StationProcess;
using testing::HasSubstr;

constexpr auto kLong = 60000ms;

// Ready it is not: every scan would fail.
TEST(StationTrouble, SaysWhichCameraSeesNothingBeforeAnybodyScans) {
  StationProcess station("fault_script = \"faults.txt\"\n");
  std::ofstream(station.folder() / "faults.txt") << "camera left: zero frames 1-1000000\n";
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=degraded", kLong)) << station.log();
  EXPECT_THAT(station.run_instep("status").text, HasSubstr("camera left: it sees nothing"));
}

// What a thread that was left behind uses must not be torn down under it.
TEST(StationTrouble, EndsOrderlyWhileTheTruthOfItsSimulationIsWorkedOut) {
  StationProcess station;
  station.write_settings(
      "[[camera]]\nkind = \"simulated\"\n"
      "[simulation]\nsubject = \"feet\"\npacing = \"fast\"\ntruth = true\n");
  for (int start = 0; start < 3; ++start) {
    station.start();
    ASSERT_TRUE(station.wait_for("READY=1", kLong)) << station.log();
    station.signal(SIGTERM);
    EXPECT_EQ(station.wait_for_exit(kLong), 0) << station.log();
  }
}

TEST(StationTrouble, LogsTheStagesOfAScanWhereTheLevelIsDebug) {
  for (const bool debug : {false, true}) {
    StationProcess station(debug ? "[log]\nlevel = \"debug\"\n" : "");
    station.start();
    ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
    ASSERT_EQ(station.run_instep("scan").exit_code, 0);
    for (const auto* stage : {"scan is at capture\n", "scan is at store\n"}) {
      EXPECT_EQ(station.log().find(stage) != std::string::npos, debug) << stage << station.log();
    }
  }
}

TEST(StationTrouble, SaysOnceThatItStopsHoweverOftenItIsTold) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  ASSERT_EQ(station.run_instep("scan --no-wait").exit_code, 0);
  for (const int number : {SIGSTOP, SIGTERM, SIGINT, SIGCONT}) station.signal(number);
  ASSERT_EQ(station.wait_for_exit(kLong), 0) << station.log();
  const std::string log = station.log();
  const auto first = log.find("stopping");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find(" stopping\n", first + 1), std::string::npos) << log;
}

// Ten minutes later there is still no socket to talk to.
TEST(StationTrouble, IsNotWaitedForWhereNobodyCanBeReachedHoweverLong) {
  const test::TemporaryFolder folder;
  const auto no_socket = folder.path() / "control.sock";
  std::ofstream(no_socket) << "no socket";
  ::setenv("INSTEP_SOCKET", no_socket.c_str(), 1);
  const auto begun = std::chrono::steady_clock::now();
  const auto status = test::run_program("instep", {"status", "--wait-ready", "600"});
  ::unsetenv("INSTEP_SOCKET");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, kLong);
  EXPECT_EQ(status.exit_code, 1);
  EXPECT_THAT(status.errors, HasSubstr("is there and is no socket"));
}

}  // namespace
}  // namespace instep
