#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/support/places.h"
#include "tests/support/station_process.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct ShellRun {
  int exit_code = -1;
  std::string text;  ///< stdout and stderr
};

ShellRun shell(const std::string& command) {
  ShellRun run;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return run;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    run.text += static_cast<char>(c);
  }
  const int status = ::pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

ShellRun install(const std::string& environment, const std::string& options) {
  const fs::path build = test::built_programs().parent_path();
  return shell(environment + " cmake --install " + build.string() + " " + options);
}

bool has_tool(const std::string& tool) {
  return shell("command -v " + tool).exit_code == 0;
}

/// An installation below a folder that goes with the test.
class Installation : public testing::Test {
 protected:
  void SetUp() override {
    const auto run = install("", "--prefix " + prefix().string());
    ASSERT_EQ(run.exit_code, 0) << run.text;
  }
  fs::path prefix() const { return folder_.path() / "prefix"; }
  fs::path unit() const { return prefix() / "lib/systemd/system/instepd.service"; }

  test::TemporaryFolder folder_;
};

TEST_F(Installation, PutsEverythingBelowItsPrefix) {
  for (const auto* file : {"bin/instepd", "bin/instep", "bin/instep-openni",
                           "etc/instep/instep.toml", "lib/systemd/system/instepd.service",
                           "lib/sysusers.d/instep.conf", "lib/tmpfiles.d/instep.conf"}) {
    EXPECT_TRUE(fs::is_regular_file(prefix() / file)) << file;
  }
  EXPECT_THAT(bytes_of(unit()),
              HasSubstr("ExecStart=" + (prefix() / "bin/instepd").string() + "\n"));
}

/// The measuring, which the programs share and which may be built for two kinds of processor; moved
/// to another place all the same.
TEST_F(Installation, BringsItsLibraries) {
  const auto moved = folder_.path() / "moved";
  fs::rename(prefix(), moved);
  const auto linked = shell("ldd " + (moved / "bin/instep").string());
  EXPECT_THAT(linked.text, HasSubstr((moved / "bin").string() + "/../lib"));
  EXPECT_THAT(linked.text, Not(HasSubstr("not found")));
  EXPECT_THAT(linked.text, Not(HasSubstr(test::built_programs().parent_path().string())));

  const auto libraries = shell("find " + moved.string() + " -name libinstep_core.so").text;
  EXPECT_EQ(std::count(libraries.begin(), libraries.end(), '\n'), INSTEP_BUILT_WIDE ? 2 : 1)
      << libraries;
  const bool wide = libraries.find("/instep/glibc-hwcaps/x86-64-v3/") != std::string::npos;
  EXPECT_EQ(wide, bool{INSTEP_BUILT_WIDE}) << libraries;
}

TEST_F(Installation, RunsWithItsOwnSettings) {
  const auto settings = prefix() / "etc/instep/instep.toml";
  test::StationProcess station;
  station.set_programs(prefix() / "bin");
  station.write_settings(bytes_of(settings));
  station.start();
  const auto ready = station.run_instep("status --wait-ready 60");
  ASSERT_EQ(ready.exit_code, 0) << ready.text << station.log();
  const auto scan = station.run_instep("scan");
  EXPECT_EQ(scan.exit_code, 0) << scan.text;
  EXPECT_THAT(scan.text, HasSubstr("foot_length"));
  EXPECT_THAT(scan.text, HasSubstr("truth"));
  station.signal(SIGTERM);
  EXPECT_EQ(station.wait_for_exit(60s), 0);
}

TEST_F(Installation, FindsItsSettingsBesideThePrograms) {
  if (fs::exists("/etc/instep/instep.toml"))
    GTEST_SKIP() << "this machine has a station's settings";
  const auto check =
      shell("env -u INSTEP_CONFIG " + (prefix() / "bin/instepd").string() + " --check");
  EXPECT_EQ(check.exit_code, 0) << check.text;
  EXPECT_THAT(check.text, HasSubstr((prefix() / "etc/instep/instep.toml").string()));
}

/// An update put the shipped ones in their place: a station measured simulated feet.
TEST_F(Installation, LeavesTheSettingsOfAStationAlone) {
  const auto settings = prefix() / "etc/instep/instep.toml";
  const std::string shipped = bytes_of(settings);
  std::ofstream(settings) << "# ours\n";
  ASSERT_EQ(install("", "--prefix " + prefix().string()).exit_code, 0);
  EXPECT_EQ(bytes_of(settings), "# ours\n");
  EXPECT_EQ(bytes_of(prefix() / "etc/instep/instep.toml.new"), shipped);
}

TEST_F(Installation, CanBeStagedForAPackage) {
  const auto stage = folder_.path() / "stage";
  const auto run = install("DESTDIR=" + stage.string(), "--prefix /opt/instep");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto below = stage / "opt/instep";
  EXPECT_TRUE(fs::is_regular_file(below / "bin/instepd"));
  EXPECT_TRUE(fs::is_regular_file(below / "etc/instep/instep.toml"));
  EXPECT_THAT(bytes_of(below / "lib/systemd/system/instepd.service"),
              HasSubstr("ExecStart=/opt/instep/bin/instepd\n"));
}

TEST_F(Installation, ServiceLeavesTheCamerasReachable) {
  const auto text = bytes_of(unit());
  // Each of these takes the devices or their events away.
  for (const auto* trap : {"\nPrivateNetwork=", "\nPrivateUsers=", "\nPrivateDevices="}) {
    EXPECT_THAT(text, Not(HasSubstr(trap)));
  }
  EXPECT_THAT(text, HasSubstr("\nRestrictAddressFamilies=AF_UNIX AF_NETLINK\n"));
  EXPECT_THAT(text, HasSubstr("\nIPAddressDeny=any\n"));
  EXPECT_THAT(text, HasSubstr("\nDevicePolicy=closed\n"));
  for (const auto* device : {"char-video4linux rw", "char-usb_device rw", "char-gpiochip rw"}) {
    EXPECT_THAT(text, HasSubstr(std::string("\nDeviceAllow=") + device + "\n"));
  }
  // A device class that is not loaded when the service starts is not let through later.
  for (const auto* order : {"\nWants=", "\nAfter="}) {
    EXPECT_THAT(text, HasSubstr(std::string(order) +
                                "modprobe@videodev.service modprobe@uvcvideo.service\n"));
  }
}

TEST_F(Installation, ServiceIsWatchedAndRestarted) {
  const auto text = bytes_of(unit());
  for (const auto* line :
       {"\nType=notify\n", "\nWatchdogSec=10\n", "\nRestart=on-failure\n", "\nUser=instep\n",
        "\nStateDirectory=instep\n", "\nRuntimeDirectory=instep\n", "\nCapabilityBoundingSet=\n"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
  const auto service = text.find("\n[Service]");
  EXPECT_LT(text.find("\nStartLimitBurst="), service) << "unknown outside [Unit]";
  EXPECT_LT(text.find("\nStartLimitIntervalSec="), service) << "unknown outside [Unit]";
}

TEST_F(Installation, ServiceIsUnderstoodBySystemd) {
  if (!has_tool("systemd-analyze")) GTEST_SKIP() << "needs systemd-analyze";
  const auto verify = shell("systemd-analyze verify --man=no " + unit().string());
  // What it says of the machine's own units is not ours.
  EXPECT_THAT(verify.text, Not(HasSubstr("instepd.service"))) << verify.text;
}

TEST_F(Installation, ServiceIsWellShutIn) {
  if (!has_tool("systemd-analyze")) GTEST_SKIP() << "needs systemd-analyze";
  const auto score =
      shell("systemd-analyze security --offline=true --threshold=20 " + unit().string());
  EXPECT_EQ(score.exit_code, 0) << score.text;
}

}  // namespace
}  // namespace instep
