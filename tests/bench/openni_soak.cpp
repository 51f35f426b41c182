// Unplugs and replugs a simulated OpenNI2 sensor many times, and captures from four for a while,
// and prints what that cost.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/support/openni_soak.h"

int main(int count, char** arguments) {
  int cycles = 1000;
  int seconds = 60;
  CLI::App app("OpenNI2 sensors: what is left after unplugging, what steady capture costs");
  app.add_option("--cycles", cycles, "times a sensor is unplugged and plugged in")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--seconds", seconds, "of capture from four sensors")
      ->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, count, arguments);

  using namespace instep::test;
  const ReplugFigures replugged = replug(cycles);
  std::printf("unplugged and plugged in %d times\n", cycles);
  std::printf("  threads      %zu before, %zu after\n", replugged.before.threads,
              replugged.after.threads);
  std::printf("  descriptors  %zu before, %zu after\n", replugged.before.descriptors,
              replugged.after.descriptors);
  std::printf("  resident     %ld kB before, %ld kB after\n",
              static_cast<long>(replugged.before.resident_kb),
              static_cast<long>(replugged.after.resident_kb));
  std::printf("  plugged in to first frame: median %ld ms, slowest %ld ms\n",
              static_cast<long>(replugged.median_recovery.count()),
              static_cast<long>(replugged.slowest_recovery.count()));
  const SteadyFigures steady = capture_steadily(4, std::chrono::seconds(seconds));
  std::printf("captured from 4 sensors of 640x480 for %d s\n", seconds);
  std::printf("  frames       %lu, of which lost on the way: %lu\n",
              static_cast<unsigned long>(steady.frames + steady.lost),
              static_cast<unsigned long>(steady.lost));
  std::printf(
      "  processor    %.3f cores in the daemon's place, %.3f in instep-openni and the "
      "simulated sensors\n",
      steady.daemon_cores, steady.children_cores);
  return 0;
}
