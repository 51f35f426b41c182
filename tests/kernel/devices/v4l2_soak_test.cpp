#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/kernel/devices/one_camera_station.h"
#include "tests/support/station_process.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;

/// What a process holds, as /proc shows it.
struct Holdings {
  std::ptrdiff_t descriptors = 0;
  std::ptrdiff_t threads = 0;
  std::ptrdiff_t video_mappings = 0;
  long resident_kib = 0;
};

Holdings holdings_of(pid_t process) {
  const std::filesystem::path proc = "/proc/" + std::to_string(process);
  const auto entries = [&](const char* folder) {
    return std::distance(std::filesystem::directory_iterator(proc / folder),
                         std::filesystem::directory_iterator());
  };
  Holdings holdings{entries("fd"), entries("task"), 0, 0};
  std::ifstream maps(proc / "maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("/dev/video") != std::string::npos) ++holdings.video_mappings;
  }
  long pages = 0;
  std::ifstream(proc / "statm") >> pages >> pages;
  holdings.resident_kib = pages * 4;
  return holdings;
}

// What one replug leaves behind, months of them bring the station down with.
TEST(V4l2Soak, TheDaemonKeepsNothingOver100Replugs) {
  UsbDepthCamera usb({}, flat_scene());
  StationProcess station;
  station.write_settings(one_camera_settings());
  usb.plug();
  station.start();
  Holdings early;
  for (int round = 0; round <= 100; ++round) {
    ASSERT_TRUE(station.wait_for("STATUS=ready", 10s)) << "round " << round << station.log();
    if (round == 10) early = holdings_of(station.process());
    if (round == 100) break;
    usb.unplug();
    ASSERT_TRUE(station.wait_for("STATUS=degraded", 10s)) << "round " << round << station.log();
    usb.plug();
  }
  const Holdings late = holdings_of(station.process());
  EXPECT_EQ(late.descriptors, early.descriptors);
  EXPECT_EQ(late.threads, early.threads);
  EXPECT_EQ(late.video_mappings, 0);
  EXPECT_LT(late.resident_kib - early.resident_kib, 2048);
  std::printf("descriptors %td, threads %td, memory %ld KiB, then %ld KiB\n", late.descriptors,
              late.threads, early.resident_kib, late.resident_kib);
}

}  // namespace
}  // namespace instep::test
