#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>

#include "tests/kernel/devices/gpio_chip.h"
#include "tests/support/station_process.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

constexpr auto kLong = 40s;

/// A station in front of real lines of the kernel: three lamps and the projector, each on a
/// chip of its own.
class StationWithOutputs : public testing::Test {
 protected:
  void start() {
    green_.close_contact();  // pulled down, it is lit by the daemon alone
    // Real time, and long enough to look at.
    station_.write_settings(
        "[[camera]]\nkind = \"simulated\"\n"
        "[capture]\nframes_per_camera = 20\nwarmup_frames = 0\n"
        "[simulation]\nwidth_px = 160\nheight_px = 120\ncameras = 3\n"
        "truth = false\n[lamp.ready]\nline = \"green\"\n[lamp.busy]\nline = \"yellow\"\n"
        "[lamp.fault]\nline = \"red\"\nactive = \"low\"\n"
        "[projector]\nline = \"light\"\n");
    station_.start();
  }
  using Lit = std::set<std::string>;
  Lit lit() const {
    Lit names;
    if (green_.level()) names.insert("ready");
    if (yellow_.level()) names.insert("busy");
    if (!red_.level()) names.insert("fault");
    if (light_.level()) names.insert("projector");
    return names;
  }
  bool shows(const Lit& wanted) const {
    const auto deadline = steady_clock::now() + kLong;
    while (lit() != wanted && steady_clock::now() < deadline) std::this_thread::sleep_for(5ms);
    return lit() == wanted;
  }

  GpioChip green_{"green", "first", 1, "green"};
  GpioChip yellow_{"yellow", "second", 1, "yellow"};
  GpioChip red_{"red", "third", 1, "red"};
  GpioChip light_{"light", "fourth", 1, "light"};
  StationProcess station_;
};

TEST_F(StationWithOutputs, ShowsWhatItIsAtAndLightsTheCapture) {
  start();
  ASSERT_TRUE(shows({"ready"})) << station_.log();
  station_.tap_pedal();
  ASSERT_TRUE(shows({"busy", "projector"})) << station_.log();
  ASSERT_TRUE(shows({"busy"})) << "it measures: " << station_.log();
  ASSERT_TRUE(shows({"ready"})) << station_.log();
  // A line that is let go falls back to what pulls it.
  for (const GpioChip* chip : {&yellow_, &light_}) chip->close_contact();
  station_.signal(SIGTERM);
  ASSERT_EQ(station_.wait_for_exit(kLong), 0) << station_.log();
  EXPECT_EQ(lit(), Lit());
}

TEST_F(StationWithOutputs, ScansAllTheSameWhileAChipIsAwayAndTakesItBack) {
  start();
  ASSERT_TRUE(shows({"ready"})) << station_.log();
  green_.unplug();
  light_.unplug();
  std::this_thread::sleep_for(5s);  // it looks every two seconds
  const auto status = station_.connect().value().ask("status").value();
  EXPECT_EQ(status["state"], "ready");
  EXPECT_FALSE(status["outputs"][0]["ok"].get<bool>());
  EXPECT_TRUE(status["outputs"][1]["ok"].get<bool>());
  const auto scan = station_.run_instep("scan --format json");
  EXPECT_EQ(scan.exit_code, 0) << scan.text;
  green_.plug_in();
  green_.close_contact();
  light_.plug_in();
  ASSERT_TRUE(shows({"ready"})) << station_.log();
  const std::string log = station_.log();
  const std::string complaint = "lamp.ready: ";
  const auto first = log.find(complaint);
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find(complaint, first + 1), std::string::npos) << "it is said once: " << log;
}

}  // namespace
}  // namespace instep::test
