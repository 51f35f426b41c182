#include "drivers/usb/usb_devices.h"

#include <algorithm>
#include <string>

#include "drivers/files/folder_entries.h"
#include "drivers/usb/sysfs.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHub = "09";

/// "4" as "004".
std::string three_digits(const std::string& number) {
  return number.size() < 3 ? std::string(3 - number.size(), '0') + number : number;
}

}  // namespace

std::vector<PluggedUsbDevice> list_usb_devices(const fs::path& sysfs, const fs::path& dev) {
  std::vector<PluggedUsbDevice> devices;
  for (const auto& folder : entries_of(sysfs / "bus/usb/devices").paths) {
    // Interfaces stand here too, as 1-2:1.0.
    if (folder.filename().native().find(':') != std::string::npos) continue;
    if (sysfs_line(folder / "bDeviceClass") == kHub) continue;
    auto device = read_usb_device(folder);
    if (!device) continue;
    devices.push_back({std::move(*device), sysfs_line(folder / "idVendor"),
                       dev / "bus/usb" / three_digits(sysfs_line(folder / "busnum")) /
                           three_digits(sysfs_line(folder / "devnum"))});
  }
  std::sort(devices.begin(), devices.end(), [](const auto& a, const auto& b) {
    return a.device.address.bus_path < b.device.address.bus_path;
  });
  return devices;
}

}  // namespace instep
