#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace instep {

/// A depth sensor on the simulated bus, as the file that plugs it in describes it. The file has a
/// key and its value on each line; a file that does not say all but the faults is not plugged in.
///
///     serial A1
///     uri sim://1/7          as on a real bus, another one after each plugging in
///     frames /tmp/left.raw   16-bit depth images in the finest unit, one after another, repeated
///     width 640
///     height 480
///     unit_um 100            finest depth unit the sensor offers: 100 or 1000
///     hfov_rad 1.0145        field of view
///     vfov_rad 0.7898
///     fault stall            any number of them; see module.cpp
struct BusDevice {
  std::string serial;
  std::string uri;
  std::filesystem::path frames;
  int width = 0;
  int height = 0;
  int unit_um = 0;
  float hfov_rad = 0.0F;
  float vfov_rad = 0.0F;
  std::set<std::string> faults;

  bool has(const std::string& fault) const { return faults.count(fault) != 0; }
};

/// The sensors that are plugged in, by the name of their file: those of the folder that end in
/// ".device". Empty if there is no such folder.
std::map<std::string, BusDevice> read_bus(const std::filesystem::path& folder);

}  // namespace instep
