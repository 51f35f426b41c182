#include "drivers/usb/usb_device.h"

#include <charconv>

#include "drivers/usb/sysfs.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

constexpr int kSuperSpeedMbps = 5000;

double number_in(const std::string& text) {
  double value = 0.0;
  const auto begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return value;
  std::from_chars(text.data() + begin, text.data() + text.size(), value);
  return value;
}

/// Of "pci0000:00/0000:00:14.0/usb1/1-2/1-2.3" the controller is the folder above usb1.
std::string bus_path_of(const fs::path& folder, const std::string& ports) {
  for (fs::path place = folder; place.has_relative_path(); place = place.parent_path()) {
    if (place.filename().string().starts_with("usb")) {
      return "usb-" + place.parent_path().filename().string() + "-" + ports;
    }
  }
  return {};
}

}  // namespace

bool UsbDevice::is_meant_by(const UsbAddress& wanted) const {
  const bool path_fits = wanted.bus_path.empty() || wanted.bus_path == address.bus_path;
  const bool serial_fits = wanted.serial.empty() || wanted.serial == address.serial;
  return path_fits && serial_fits;
}

std::string UsbDevice::text() const {
  return "\"" + product + "\"" + (address.serial.empty() ? "" : ", serial " + address.serial) +
         (address.bus_path.empty() ? "" : ", at " + address.bus_path);
}

std::optional<UsbDevice> read_usb_device(const fs::path& folder) {
  std::error_code gone;
  fs::path place = fs::canonical(folder, gone);
  while (!gone && place.has_relative_path() && !fs::exists(place / "devpath", gone)) {
    place = place.parent_path();
  }
  if (gone || !place.has_relative_path()) return std::nullopt;
  UsbDevice device;
  device.address.bus_path = bus_path_of(place, sysfs_line(place / "devpath"));
  device.address.serial = sysfs_line(place / "serial");
  device.product = sysfs_line(place / "product");
  device.link_mbps = static_cast<int>(number_in(sysfs_line(place / "speed")));
  constexpr double kFirstWithMoreSpeeds = 2.1;
  device.could_be_faster = number_in(sysfs_line(place / "version")) >= kFirstWithMoreSpeeds &&
                           device.link_mbps > 0 && device.link_mbps < kSuperSpeedMbps;
  return device;
}

}  // namespace instep
