// Prints how long after its edge a press of the pedal makes the station capture: the real daemon,
// the simulated pedal, 200 presses, as somebody who watches the daemon's socket sees it. The
// debounce time (30 ms) is a part of it.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/station_process.h"

namespace {

using namespace instep;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kPresses = 200;
constexpr auto kLimit = 30s;

/// False if the daemon never says that it is in this state.
bool wait_for_state(ControlClient& watching, const std::string& state) {
  const auto end = Clock::now() + kLimit;
  while (Clock::now() < end) {
    const auto event = watching.next(kLimit);
    if (!event) return false;
    if (event->value("event", "") == "status" && event->value("state", "") == state) return true;
  }
  return false;
}

void write_line(const test::StationProcess& station, const char* line) {
  std::ofstream(station.folder() / "pedal") << line << '\n';
}

}  // namespace

int main() {
  test::StationProcess station;
  station.write_settings(test::StationProcess::tiny_settings());
  station.start();
  if (!station.wait_for("STATUS=ready", kLimit)) return 1;
  auto watching = station.connect();
  if (!watching || !watching->ask("watch")) return 1;

  std::vector<double> times_ms;
  while (times_ms.size() < kPresses) {
    const auto pressed = Clock::now();
    write_line(station, "press");
    if (!wait_for_state(*watching, "capturing")) {
      std::printf("press %zu did nothing\n", times_ms.size() + 1);
      return 1;
    }
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - pressed).count());
    write_line(station, "release");
    if (!wait_for_state(*watching, "ready")) return 1;
  }
  std::sort(times_ms.begin(), times_ms.end());
  std::printf("edge to capture, %zu presses: median %.1f ms, p99 %.1f ms, most %.1f ms\n", kPresses,
              times_ms[kPresses / 2], times_ms[kPresses * 99 / 100 - 1], times_ms.back());
}
