// Prints the time of a scan by stage, from the last frame to the measures: 4 cameras x 15 frames of
// 640x480, the median of five scans.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "daemon/scan/scan_pipeline.h"
#include "sim/simulated_station.h"
#include "tests/support/simulated_capture.h"

namespace {

using namespace instep;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kScans = 5;

Result<Capture> simulated_capture() {
  SimulationSettings settings;
  settings.pacing = Pacing::kAsFastAsPossible;
  auto station = build_station(settings);
  if (!station) return tl::make_unexpected(station.error());
  return test::capture_of(*station);
}

double median(std::array<double, kScans> values) {
  std::sort(values.begin(), values.end());
  return values[kScans / 2];
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

int main() {
  const auto capture = simulated_capture();
  if (!capture) {
    std::printf("%s\n", capture.error().line().c_str());
    return 1;
  }
  const double memory_before = peak_memory_mb();
  std::map<std::string, std::array<double, kScans>> stages;
  for (std::size_t scan = 0; scan < kScans; ++scan) {
    const auto start = Clock::now();
    const auto records = measure_capture(*capture, {}, {});
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
    if (!records) {
      std::printf("%s\n", records.error().line().c_str());
      return 1;
    }
    stages["total"][scan] = elapsed.count();
    for (const auto& [stage, milliseconds] : records->front().timings_ms) {
      stages[stage][scan] = milliseconds;
    }
  }
  for (const auto& [stage, milliseconds] : stages) {
    std::printf("%-20s %8.1f ms\n", stage.c_str(), median(milliseconds));
  }
  std::printf("%-20s %8.1f MB (%.1f with the frames alone)\n", "peak memory", peak_memory_mb(),
              memory_before);
}
