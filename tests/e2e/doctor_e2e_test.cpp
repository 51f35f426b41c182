#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "daemon/control/unix_socket.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The doctor of a sound station with no daemon, whose results go where `store` says.
class Doctor : public testing::Test {
 protected:
  Doctor() {
    const auto file = folder_.path() / "instep.toml";
    std::ofstream(file) << "[[camera]]\nkind = \"simulated\"\n"
                           "[simulation]\ncameras = 1\nwidth_px = 64\nheight_px = 48\n";
    ::setenv("INSTEP_CONFIG", file.c_str(), 1);
    ::setenv("INSTEP_SOCKET", (folder_.path() / "control.sock").c_str(), 1);
    ::setenv("INSTEP_PEDAL", (folder_.path() / "pedal").c_str(), 1);
  }
  ~Doctor() override {
    for (const char* name : {"INSTEP_CONFIG", "INSTEP_SOCKET", "INSTEP_PEDAL", "INSTEP_STORE"}) {
      ::unsetenv(name);
    }
  }

  static json checks(const fs::path& store) {
    ::setenv("INSTEP_STORE", store.c_str(), 1);
    const auto run = test::run_program("instep", {"doctor", "--format", "json"});
    EXPECT_EQ(run.exit_code, 1) << "no daemon answers: " << run.errors;
    return json::parse(run.output)["checks"];
  }
  /// The one of that name; null if it was not made.
  static json named(const std::string& name, const json& checks) {
    for (const auto& one : checks) {
      if (one["name"] == name) return one;
    }
    return nullptr;
  }
  static json check(const std::string& name, const fs::path& store) {
    return named(name, checks(store));
  }

  test::TemporaryFolder folder_;
};

TEST_F(Doctor, FindsAStoreSoundThatIsThereOrCanBeMade) {
  for (const fs::path& store : {folder_.path(), folder_.path() / "scans", fs::path("scans")}) {
    EXPECT_EQ(check("store", store)["good"], true) << store;
    EXPECT_EQ(check("disk", store)["good"], true) << store;
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "scans")) << "it changes nothing";
}

TEST_F(Doctor, NamesTheFolderThatIsMissingForTheStoreAndSaysItOnce) {
  const auto missing = folder_.path() / "none";
  const json store = check("store", missing / "scans");
  EXPECT_EQ(store["good"], false);
  EXPECT_EQ(store["finding"], missing.string() + " is not there");
  EXPECT_NE(store["remedy"], "");
  EXPECT_EQ(check("disk", missing / "scans"), nullptr);
}

TEST_F(Doctor, NamesAFileThatIsInTheStoresPlace) {
  const auto file = folder_.path() / "instep.toml";
  const json store = check("store", file);
  EXPECT_EQ(store["good"], false);
  EXPECT_EQ(store["finding"], file.string() + " is no folder");
  EXPECT_EQ(check("store", file / "scans")["good"], false);
}

TEST_F(Doctor, TellsADiskThatTakesNothingFromAFolderThatOneMayNotWriteIn) {
  const auto disk = folder_.path() / "disk";
  fs::create_directory(disk);
  if (::geteuid() != 0 || ::mount("tmpfs", disk.c_str(), "tmpfs", MS_RDONLY, "") != 0) {
    GTEST_SKIP() << "needs the right to mount a disk";
  }
  const auto store = check("store", disk);
  ::umount(disk.c_str());
  EXPECT_EQ(store["good"], false);
  EXPECT_NE(store.dump().find("mounted read-only"), std::string::npos) << store;
}

/// What it holds was taken from it, or said to be somebody else's.
TEST_F(Doctor, OpensNoDeviceOfADaemonThatDoesNotAnswer) {
  EXPECT_EQ(check("cameras", folder_.path())["good"], true) << "without one";
  const auto socket = ListeningSocket::open(folder_.path() / "control.sock");
  ASSERT_TRUE(socket) << socket.error().line();
  const json all = checks(folder_.path());
  EXPECT_EQ(named("cameras", all), nullptr);
  EXPECT_EQ(named("daemon", all)["good"], false);
  const json devices = named("devices", all);
  EXPECT_TRUE(devices["good"].is_null()) << devices;
  EXPECT_EQ(devices["remedy"], "sudo systemctl restart instepd");
}

}  // namespace
}  // namespace instep
