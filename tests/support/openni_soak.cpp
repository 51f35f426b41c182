#include "tests/support/openni_soak.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/support/openni_bus.h"

namespace instep::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::size_t entries_of(const char* folder) {
  const auto all = std::filesystem::directory_iterator(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

Holdings holdings() {
  std::ifstream stream("/proc/self/statm");
  std::int64_t size = 0;
  std::int64_t resident = 0;
  stream >> size >> resident;
  return {entries_of("/proc/self/task"), entries_of("/proc/self/fd"),
          resident * ::sysconf(_SC_PAGESIZE) / 1024};
}

/// Until a frame has come, as the daemon tries it.
void wait_for_frame(DepthCamera& camera) {
  const auto deadline = steady_clock::now() + 20s;
  while (steady_clock::now() < deadline) {
    const auto frame = camera.start().and_then([&] { return camera.next_frame(5s); });
    if (frame) return;
    std::this_thread::sleep_for(5ms);
  }
  throw std::runtime_error("the sensor did not come back");
}

milliseconds replug_once(OpenniBus& bus, DepthCamera& camera) {
  bus.unplug("A1");
  while (camera.next_frame(5s)) continue;
  bus.plug_in({});
  const auto begin = steady_clock::now();
  wait_for_frame(camera);
  return std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin);
}

std::chrono::duration<double> processor_time_of(const std::string& process) {
  std::ifstream stream("/proc/" + process + "/stat");
  std::string text;
  std::getline(stream, text);
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  constexpr int kFieldsBefore = 11;  // those between the program's name and its times
  std::string skipped;
  for (int i = 0; i < kFieldsBefore; ++i) fields >> skipped;
  double user = 0.0;
  double system = 0.0;
  fields >> user >> system;
  return std::chrono::duration<double>((user + system) /
                                       static_cast<double>(::sysconf(_SC_CLK_TCK)));
}

std::chrono::duration<double> processor_time_of_children() {
  std::chrono::duration<double> sum{0.0};
  for (const pid_t child : child_processes()) sum += processor_time_of(std::to_string(child));
  return sum;
}

/// Frames that came and that were lost between `begin` and `end`.
void count_frames(DepthCamera& camera, steady_clock::time_point end, SteadyFigures& figures) {
  auto last = camera.next_frame(5s);
  while (last && steady_clock::now() < end) {
    auto next = camera.next_frame(5s);
    if (!next) throw std::runtime_error(next.error().line());
    ++figures.frames;
    figures.lost += next->sequence - last->sequence - 1;
    last = std::move(next);
  }
}

}  // namespace

ReplugFigures replug(int cycles) {
  constexpr int kWarmUp = 10;
  OpenniBus bus;
  bus.plug_in({});
  const auto camera = bus.camera();
  wait_for_frame(*camera);
  for (int i = 0; i < kWarmUp; ++i) replug_once(bus, *camera);
  ReplugFigures figures;
  figures.before = holdings();
  std::vector<milliseconds> recoveries;
  recoveries.reserve(static_cast<std::size_t>(cycles));
  for (int i = 0; i < cycles; ++i) recoveries.push_back(replug_once(bus, *camera));
  figures.after = holdings();
  figures.children = child_processes().size();
  std::sort(recoveries.begin(), recoveries.end());
  figures.median_recovery = recoveries[recoveries.size() / 2];
  figures.slowest_recovery = recoveries.back();
  return figures;
}

SteadyFigures capture_steadily(int sensors, std::chrono::seconds time) {
  OpenniBus bus;
  std::vector<std::unique_ptr<OpenniCamera>> cameras;
  for (int i = 0; i < sensors; ++i) {
    BusSensor sensor;
    sensor.serial = fmt::format("S{}", i);
    sensor.width = 640;
    sensor.height = 480;
    bus.plug_in(sensor);
    cameras.push_back(bus.camera(sensor.serial));
  }
  for (const auto& camera : cameras) wait_for_frame(*camera);

  const auto begin = steady_clock::now();
  const auto own = processor_time_of("self");
  const auto others = processor_time_of_children();
  std::vector<SteadyFigures> each(cameras.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    threads.emplace_back([&, i] { count_frames(*cameras[i], begin + time, each[i]); });
  }
  for (auto& thread : threads) thread.join();
  const std::chrono::duration<double> spent = steady_clock::now() - begin;
  SteadyFigures all;
  for (const auto& one : each) {
    all.frames += one.frames;
    all.lost += one.lost;
  }
  all.daemon_cores = (processor_time_of("self") - own) / spent;
  all.children_cores = (processor_time_of_children() - others) / spent;
  return all;
}

}  // namespace instep::test
