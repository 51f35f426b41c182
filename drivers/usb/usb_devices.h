#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/usb/usb_device.h"

namespace instep {

/// A device that is plugged in, whether or not a driver serves it.
struct PluggedUsbDevice {
  UsbDevice device;
  std::string vendor;          ///< four hexadecimal digits
  std::filesystem::path node;  ///< such as /dev/bus/usb/001/004, which libusb opens
};

/// All devices on the bus but its hubs' own, by their place. `sysfs` and `dev` are /sys and /dev.
std::vector<PluggedUsbDevice> list_usb_devices(const std::filesystem::path& sysfs,
                                               const std::filesystem::path& dev);

}  // namespace instep
