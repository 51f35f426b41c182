#include "sim/openni2_module/bus_folder.h"

#include <fstream>
#include <sstream>

#include "drivers/files/folder_entries.h"

namespace instep {
namespace {

BusDevice read_device(const std::filesystem::path& file) {
  BusDevice device;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "serial") words >> device.serial;
    if (key == "uri") words >> device.uri;
    if (key == "frames") words >> device.frames;
    if (key == "width") words >> device.width;
    if (key == "height") words >> device.height;
    if (key == "unit_um") words >> device.unit_um;
    if (key == "hfov_rad") words >> device.hfov_rad;
    if (key == "vfov_rad") words >> device.vfov_rad;
    if (key == "fault" && words >> key) device.faults.insert(key);
  }
  return device;
}

bool is_whole(const BusDevice& device) {
  constexpr int kLargestSide = 4096;
  const auto sound = [](int side) { return side >= 2 && side <= kLargestSide && side % 2 == 0; };
  return !device.uri.empty() && !device.frames.empty() && sound(device.width) &&
         sound(device.height) && (device.unit_um == 100 || device.unit_um == 1000);
}

}  // namespace

std::map<std::string, BusDevice> read_bus(const std::filesystem::path& folder) {
  std::map<std::string, BusDevice> devices;
  for (const auto& file : entries_of(folder).paths) {
    if (file.extension() != ".device") continue;
    BusDevice device = read_device(file);
    if (is_whole(device)) devices.emplace(file.filename().string(), std::move(device));
  }
  return devices;
}

}  // namespace instep
