#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "daemon/scan/scan_id.h"
#include "tests/support/station_process.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using test::StationProcess;
using testing::HasSubstr;

constexpr auto kLong = 60000ms;

/// The next event of a kind.
Result<json> next_event(ControlClient& client, const std::string& kind) {
  while (true) {
    auto line = client.next(kLong);
    if (!line || line->value("event", "") == kind) return line;
  }
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every folder with the name of a scan holds three whole files.
void check_results(const std::filesystem::path& store, std::size_t& count) {
  count = 0;
  if (!std::filesystem::exists(store)) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store)) {
    if (!entry.is_directory() || !is_scan_id(entry.path().filename().string())) continue;
    ++count;
    const auto result = json::parse(bytes_of(entry.path() / "result.json"), nullptr, false);
    ASSERT_TRUE(result.is_object()) << entry.path();
    ASSERT_EQ(result.value("id", ""), entry.path().filename().string());
    ASSERT_THAT(bytes_of(entry.path() / "sections.svg"), HasSubstr("</svg>")) << entry.path();
    ASSERT_EQ(bytes_of(entry.path() / "cloud.ply").substr(0, 3), "ply") << entry.path();
  }
}

std::size_t leftovers(const std::filesystem::path& store) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store)) {
    if (entry.path().filename().string().starts_with('.')) ++count;
  }
  return count;
}

TEST(Station, MakesAResultOfAPressOfThePedal) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("READY=1", kLong)) << station.log();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  auto watching = station.connect();
  ASSERT_TRUE(watching);
  ASSERT_TRUE(watching->ask("watch"));
  station.tap_pedal();
  const auto result = next_event(*watching, "result");
  ASSERT_TRUE(result) << station.log();
  const std::filesystem::path folder = result->at("scans").at(0).at("folder").get<std::string>();
  for (const auto* file : {"result.json", "cloud.ply", "sections.svg", "report.svg"}) {
    EXPECT_GT(std::filesystem::file_size(folder / file), 0U) << file;
  }
  std::size_t count = 0;
  check_results(station.store(), count);
  EXPECT_EQ(count, 1U);
}

TEST(Station, IsReachedByEveryCommand) {
  StationProcess station;
  station.start();
  const auto ready = station.run_instep("status --wait-ready 60");
  ASSERT_EQ(ready.exit_code, 0) << ready.text;
  const auto scan = station.run_instep("scan");
  ASSERT_EQ(scan.exit_code, 0) << scan.text;
  EXPECT_THAT(scan.text, HasSubstr("foot_length"));
  EXPECT_EQ(station.run_instep("show latest").text, scan.text);
  const auto list = station.run_instep("list");
  const std::string id = list.text.substr(0, list.text.find('\n'));
  ASSERT_TRUE(is_scan_id(id)) << list.text;
  const auto in_detail = station.run_instep("list --long");
  EXPECT_EQ(in_detail.text.rfind(id + "  ", 0), 0U) << in_detail.text;
  EXPECT_THAT(in_detail.text, HasSubstr("length "));
  EXPECT_EQ(station.run_instep("list --long --format json").exit_code, 2)
      << "there is no such list";
  const auto out = station.folder() / "out";
  EXPECT_EQ(station.run_instep("export " + id + " --out " + out.string()).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(out / id / "cloud.ply"));
  const auto again = station.run_instep("export latest --out " + out.string());
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.text, HasSubstr("is there already"));
  EXPECT_EQ(station.run_instep("delete " + id).exit_code, 0);
  const auto gone = station.run_instep("show " + id);
  EXPECT_EQ(gone.exit_code, 1);
  EXPECT_THAT(gone.text, HasSubstr("there is no scan"));
  EXPECT_EQ(station.run_instep("list").text, "");
  EXPECT_EQ(leftovers(station.store()), 0U);
}

/// Two objects one after the other were no JSON.
TEST(Station, TellsAScanOfTwoFeetAsOneObject) {
  StationProcess station("subject = \"feet\"\n");
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0);
  const auto scan = station.run_instep("scan --format json");
  ASSERT_EQ(scan.exit_code, 0) << scan.text;
  const auto both = json::parse(scan.text, nullptr, false);
  ASSERT_TRUE(both.is_object()) << scan.text;
  ASSERT_EQ(both.at("results").size(), 2U);
  EXPECT_TRUE(both["results"][0].contains("measures"));
}

TEST(Station, FailsInOneLineThatHelpsWhenACommandCannotBeDone) {
  StationProcess station;
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0);
  ASSERT_EQ(station.run_instep("scan").exit_code, 0);
  const auto expect_failure = [&](const std::string& command, const std::string& said) {
    const auto output = station.run_instep(command);
    EXPECT_EQ(output.exit_code, 1) << command;
    EXPECT_THAT(output.text, HasSubstr(said)) << command;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  };
  expect_failure("show ../../../etc/passwd", "instep list");
  expect_failure("delete ../x", "instep list");
  expect_failure("delete latest", "instep list");
  expect_failure("cancel", "instep scan");
  expect_failure("export latest --out /proc/none", "check the name");
  expect_failure("export latest --out ''", "choose another name");
  for (const auto* command : {"list", "show latest", "status", "watch --until-result 30"}) {
    EXPECT_EQ(station.run_instep(command + std::string(" >/dev/full")).exit_code, 1) << command;
  }
}

TEST(Station, ExportsAScanWholeOrNotAtAll) {
  StationProcess station;
  station.start();
  ASSERT_EQ(station.run_instep("status --wait-ready 60").exit_code, 0);
  ASSERT_EQ(station.run_instep("scan").exit_code, 0);
  const auto disk = station.folder() / "disk";
  std::filesystem::create_directory(disk);
  if (::geteuid() != 0 || ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "needs the right to mount a small disk";
  }
  const auto full = station.run_instep("export latest --out " + disk.string());
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.text, HasSubstr("free some disk space"));
  EXPECT_TRUE(std::filesystem::is_empty(disk));
  ::umount(disk.c_str());
}

TEST(Station, IsSaidNotToRunByEveryCommandInOneLine) {
  const StationProcess station;
  for (const auto* command : {"scan", "status", "watch", "list", "show", "export latest",
                              "delete 20261121T091502417Z-k3f9", "cancel"}) {
    const auto output = station.run_instep(command);
    EXPECT_EQ(output.exit_code, 1) << command;
    EXPECT_THAT(output.text, HasSubstr("start it with")) << command;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
}

TEST(Station, EndsWithinASecondOfSigtermInTheMiddleOfAScan) {
  for (const int ignored_lines : {0, 1, 2, 3}) {
    StationProcess station;
    station.start();
    ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
    auto client = station.connect();
    ASSERT_TRUE(client);
    ASSERT_TRUE(client->ask("watch"));
    ASSERT_TRUE(client->ask("scan"));
    for (int i = 0; i < ignored_lines; ++i) ASSERT_TRUE(client->next(kLong));
    station.signal(SIGTERM);
    const auto exit_code = station.wait_for_exit(1500ms);
    ASSERT_TRUE(exit_code) << station.log();
    EXPECT_EQ(*exit_code, 0) << station.log();
    std::size_t count = 0;
    check_results(station.store(), count);
    EXPECT_EQ(leftovers(station.store()), 0U);
    EXPECT_FALSE(std::filesystem::exists(station.folder() / "control.sock"));
  }
}

// It was told of a scan that somebody cancelled.
TEST(Station, SaysThatItStopsToWhoWaitsForAScan) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  auto client = station.connect();
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->ask("watch"));
  ASSERT_TRUE(client->ask("scan"));
  station.signal(SIGTERM);
  auto line = client->next(kLong);
  while (line && line->value("event", "") != "failure") line = client->next(kLong);
  ASSERT_TRUE(line) << line.error().line();
  EXPECT_EQ(line->at("error").at("message"), "the station is stopping");
  EXPECT_EQ(station.wait_for_exit(kLong), 0) << station.log();
}

/// Of its memory, what is in RAM.
double resident_mb(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) * 1024.0 / 1.0e6;
  }
  return 0.0;
}

TEST(Station, RestsIn40MbAfterScansOfWholeFrames) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps memory of its own";
#endif
  StationProcess station;
  station.write_settings(
      "[[camera]]\nkind = \"simulated\"\n"
      "[capture]\nframes_per_camera = 15\nwarmup_frames = 0\n"
      "[simulation]\nwidth_px = 640\nheight_px = 480\ncameras = 4\npacing = \"fast\"\n"
      "truth = false\n");
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  for (int scan = 0; scan < 3; ++scan) {
    const auto output = station.run_instep("scan");
    ASSERT_EQ(output.exit_code, 0) << output.text;
    const double resident = resident_mb(station.process());
    EXPECT_GT(resident, 1.0);
    EXPECT_LT(resident, 40.0);
  }
}

// A scan without the projector is a scan, but its result tells of it.
TEST(Station, ScansWithoutItsProjectorAndSaysSo) {
  StationProcess station;
  station.write_settings(StationProcess::small_settings() +
                         "[projector]\nchip = \"no-such-board\"\noffset = 3\n");
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  const auto scan = station.run_instep("scan --format json");
  ASSERT_EQ(scan.exit_code, 0) << scan.text;
  EXPECT_THAT(json::parse(scan.text).at("warnings").dump(),
              HasSubstr("the projector was not lit for the whole capture: "));
}

TEST(Station, KeepsItsSettingsWhenTheNewOnesAreFaulty) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  station.write_settings(StationProcess::small_settings() + "[pedal]\ndebounce_ms = 1\n");
  station.signal(SIGHUP);
  ASSERT_TRUE(station.wait_for("RELOADING=1", kLong));
  ASSERT_TRUE(station.wait_for("READY=1", kLong));
  EXPECT_THAT(station.log(), HasSubstr("pedal.debounce_ms = 1 is outside 5 to 200"));
  EXPECT_THAT(station.run_instep("status --format json").text,
              HasSubstr("the new settings are faulty"));
  station.write_settings(StationProcess::small_settings() + "[station]\nname = \"renamed\"\n");
  station.signal(SIGHUP);
  ASSERT_TRUE(station.wait_for("READY=1", kLong));
  EXPECT_THAT(station.run_instep("status --format json").text,
              testing::Not(HasSubstr("the new settings are faulty")));
  const auto scan = station.run_instep("scan --format json");
  EXPECT_EQ(json::parse(scan.text, nullptr, false).value("station", ""), "renamed") << scan.text;
}

TEST(Station, StartsWithoutACameraAndSaysWhichIsMissing) {
  StationProcess station("fault_script = \"faults.txt\"\n");
  std::ofstream(station.folder() / "faults.txt") << "camera left: never starts\n";
  station.start();
  ASSERT_TRUE(station.wait_for("READY=1", kLong)) << station.log();
  ASSERT_TRUE(station.wait_for("STATUS=degraded", kLong)) << station.log();
  const auto scan = station.run_instep("scan");
  EXPECT_EQ(scan.exit_code, 1);
  EXPECT_THAT(scan.text, HasSubstr("camera left"));
}

TEST(Station, RecoversACameraThatComesBack) {
  StationProcess station("fault_script = \"faults.txt\"\n");
  std::ofstream(station.folder() / "faults.txt")
      << "camera left: vanish after 3 frames, return after 500 ms\n";
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  // It may be lost in one scan, and missed by the next, before the station has looked for it.
  auto scan = station.run_instep("scan");
  for (int attempt = 0; scan.exit_code != 0 && attempt < 3; ++attempt) {
    EXPECT_THAT(scan.text, HasSubstr("left"));
    const auto ready = station.run_instep("status --wait-ready 20");
    ASSERT_EQ(ready.exit_code, 0) << ready.text;
    scan = station.run_instep("scan");
  }
  EXPECT_EQ(scan.exit_code, 0) << scan.text;
}

// Damaged and empty frames, as a person sees them.
TEST(Station, CountsTheDamagedFramesOfEachCamera) {
  StationProcess station("fault_script = \"faults.txt\"\n");
  std::ofstream(station.folder() / "faults.txt") << "camera left: corrupt frames 3-5\n"
                                                    "camera left: shorten frames 6-7\n"
                                                    "camera left: zero frame 8\n";
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  for (int scan = 0; scan < 2; ++scan) {
    const auto made = station.run_instep("scan");
    ASSERT_EQ(made.exit_code, 0) << made.text;
  }
  const json status = json::parse(station.run_instep("status --format json").text);
  for (const json& camera : status.at("cameras")) {
    const bool left = camera.at("id") == "left";
    const json& frames = camera.at("frames");
    EXPECT_EQ(frames.at("error_flagged"), left ? 3 : 0) << camera;
    EXPECT_EQ(frames.at("short"), left ? 2 : 0) << camera;
    EXPECT_EQ(frames.at("empty"), left ? 1 : 0) << camera;
    EXPECT_EQ(frames.at("stale"), 0) << camera;
    EXPECT_EQ(frames.at("lost"), 0) << camera;
    EXPECT_GE(frames.at("good"), 8) << "four of each scan: " << camera;
  }
  const auto text = station.run_instep("status").text;
  EXPECT_THAT(text, HasSubstr("camera left         ok (frames: "));
  EXPECT_THAT(text, HasSubstr("good, 1 empty, 3 error-flagged, 2 short)\n"));
  EXPECT_THAT(text, HasSubstr("camera right        ok\n"));
}

TEST(Station, RefusesASecondDaemonOnItsSocket) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("READY=1", kLong));
  const pid_t first = station.process();
  station.start();
  EXPECT_EQ(station.wait_for_exit(kLong), 1);
  EXPECT_THAT(station.log(), HasSubstr("another instepd answers"));
  ::kill(first, SIGTERM);
}

TEST(Station, FeedsTheWatchdogWhileItIsWell) {
  StationProcess station;
  station.start(2s);
  ASSERT_TRUE(station.wait_for("READY=1", kLong));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(station.wait_for("WATCHDOG=1", 1500ms));
}

TEST(Station, OutlivesRudeClients) {
  StationProcess station;
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong));
  std::mt19937_64 random(9);
  std::vector<ControlClient> rude;
  for (int i = 0; i < 60; ++i) {
    auto client = station.connect();
    ASSERT_TRUE(client);
    // Far too long, and no line: the client that sends it is dropped.
    (void)client->ask(std::string(random() % 20000, 'x'), "", 50ms);
    if (i % 2 == 0) rude.push_back(std::move(*client));
  }
  rude.clear();
  const auto status = station.run_instep("status");
  EXPECT_EQ(status.exit_code, 0) << status.text;
}

TEST(Station, NamesAFullDiskAndRecoversFromIt) {
  StationProcess station;
  const auto disk = station.folder() / "disk";
  std::filesystem::create_directory(disk);
  if (::geteuid() != 0 || ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=8M") != 0) {
    GTEST_SKIP() << "needs the right to mount a small disk";
  }
  std::ofstream(disk / "filler") << std::string(9 << 20, 'x');
  station.set_store(disk / "scans");
  station.start();
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  const auto full = station.run_instep("scan");
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.text, HasSubstr("make room on the disk")) << station.log();
  ASSERT_TRUE(station.wait_for("STATUS=fault", kLong)) << station.log();
  const std::string log = station.log();
  ASSERT_NE(log.find("make room on the disk"), std::string::npos) << log;
  EXPECT_EQ(log.find("make room on the disk"), log.rfind("make room on the disk")) << log;
  std::filesystem::remove(disk / "filler");
  ASSERT_TRUE(station.wait_for("STATUS=ready", kLong)) << station.log();
  const auto next = station.run_instep("scan");
  EXPECT_EQ(next.exit_code, 0) << next.text << station.log();
  station.signal(SIGTERM);
  EXPECT_EQ(station.wait_for_exit(kLong), 0);
  EXPECT_EQ(leftovers(disk), 0U);
  ::umount(disk.c_str());
}

}  // namespace
}  // namespace instep
