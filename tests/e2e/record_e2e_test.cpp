#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "daemon/control/unix_socket.h"
#include "tests/support/background_program.h"
#include "tests/support/run_program.h"
#include "tests/support/station_process.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

bool holds_a_frame(const fs::path& folder) {
  std::error_code away;
  for (fs::recursive_directory_iterator at(folder, away), end; !away && at != end;
       at.increment(away)) {
    if (at->path().extension() == ".png") return true;
  }
  return false;
}

TEST(Record, EndsByItselfAtASignalInOneLineAndKeepsNothing) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const test::TemporaryFolder folder;
    const auto settings = folder.path() / "s.toml";
    std::ofstream(settings) << test::StationProcess::tiny_settings();
    // It would take minutes.
    test::BackgroundProgram recording(
        "instep",
        {"record", "--out", folder.path() / "visit", "--config", settings, "--frames", "10000"},
        folder.path() / "errors");
    for (int i = 0; i < 2000 && !holds_a_frame(folder.path() / "visit"); ++i) {
      std::this_thread::sleep_for(10ms);
    }
    ASSERT_TRUE(holds_a_frame(folder.path() / "visit")) << recording.errors();
    recording.signal(number);
    const int status = recording.wait_for_end();
    ASSERT_TRUE(WIFEXITED(status)) << status;
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(recording.errors(),
              "instep: the recording was stopped, nothing of it is kept: record again when you are "
              "ready\n");
    EXPECT_FALSE(fs::exists(folder.path() / "visit"));
  }
}

TEST(Simulate, LeavesNothingInTheWayOfTheNextOneHoweverItEnds) {
  const test::TemporaryFolder folder;
  const auto visit = folder.path() / "visit";
  for (const int number : {SIGINT, SIGTERM, SIGKILL}) {
    test::BackgroundProgram simulating(
        "instep", {"simulate", "--out", visit, "--subject", "cylinder", "--frames", "1000"},
        folder.path() / "errors");
    for (int i = 0; i < 2000 && !holds_a_frame(visit); ++i) std::this_thread::sleep_for(10ms);
    ASSERT_TRUE(holds_a_frame(visit)) << simulating.errors();
    simulating.signal(number);
    simulating.wait_for_end();
    EXPECT_EQ(fs::exists(visit), number == SIGKILL);
  }
  const auto next = test::run_program(
      "instep", {"simulate", "--out", visit, "--subject", "cylinder", "--frames", "1"});
  EXPECT_EQ(next.exit_code, 0) << next.errors;
}

// The daemon was asked on the socket of the settings, where it is not.
TEST(Record, AsksTheDaemonOnTheSocketThatTheEnvironmentNames) {
  const test::TemporaryFolder folder;
  const auto settings = folder.path() / "s.toml";
  std::ofstream(settings) << "[[camera]]\nkind = \"openni2\"\nname = \"only\"\nserial = \"A1\"\n"
                             "station_from_camera = [ 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 500, "
                             "0, 0, 0, 1 ]\n";
  const auto socket = folder.path() / "named.sock";
  const auto daemon = ListeningSocket::open(socket);
  ASSERT_TRUE(daemon) << daemon.error().line();
  ::setenv("INSTEP_SOCKET", socket.c_str(), 1);
  const auto record = test::run_program(
      "instep", {"record", "--out", folder.path() / "visit", "--config", settings});
  const auto calibrate = test::run_program("instep", {"calibrate", "--config", settings});
  ::unsetenv("INSTEP_SOCKET");
  const auto has_them =
      testing::HasSubstr("the daemon has the cameras: it answers on " + socket.string());
  EXPECT_THAT(record.errors, has_them);
  EXPECT_THAT(calibrate.errors, has_them);
}

}  // namespace
}  // namespace instep
