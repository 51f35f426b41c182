#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "drivers/openni2/openni_camera.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {

/// A sensor for the simulated OpenNI2 bus.
struct BusSensor {
  std::string serial = "A1";
  int width = 64;
  int height = 48;
  int unit_um = 100;
  double hfov_rad = 1.0;
  double vfov_rad = 0.8;
  std::set<std::string> faults = {};  ///< sim/openni2_module/module.cpp
  /// Repeated, in unit_um; each of width * height values. None = test_images().
  std::vector<std::vector<std::uint16_t>> images = {};
};

/// The stock OpenNI2 library with our driver module and a bus of its own, in a temporary folder.
class OpenniBus {
 public:
  OpenniBus();

  /// Plugs a sensor in, or in again, at a place where none was before; the processes that look at
  /// the bus learn of it within milliseconds.
  void plug_in(const BusSensor& sensor);
  void unplug(const std::string& serial) const;
  /// The faults of a sensor from now on, while it stays where it is.
  void set_faults(const std::string& serial, const std::set<std::string>& faults);

  /// The place of the sensor that was plugged in last.
  std::string last_uri() const { return "sim://1/" + std::to_string(plugged_in_); }

  const std::filesystem::path& folder() const { return folder_.path(); }
  OpenniProgram program() const;
  /// For a camera of that name whose sensor has that serial number.
  OpenniCamera::Settings settings(const std::string& serial = "A1") const;
  /// Opened; throws what went wrong.
  std::unique_ptr<OpenniCamera> camera(const std::string& serial = "A1") const;

 private:
  void write(const BusSensor& sensor, const std::string& uri) const;

  TemporaryFolder folder_;
  std::vector<BusSensor> sensors_;
  std::vector<std::string> uris_;
  int plugged_in_ = 0;
};

/// Two images in which each pixel has a value of its own, but for some without data, all within
/// 100 mm and 6500 mm at 0.1 mm.
std::vector<std::vector<std::uint16_t>> test_images(int width, int height);

/// The processes that this one, or `parent`, has started and not reaped, by /proc.
std::vector<pid_t> child_processes(pid_t parent = ::getpid());
/// True if such a process runs a program of that name and has not ended.
bool runs(pid_t process, const std::string& program);

}  // namespace instep::test
