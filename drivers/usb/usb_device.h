#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace instep {

/// Which of the devices on the bus is meant. Where both are given both must fit, so that a camera
/// in another's place is found out.
struct UsbAddress {
  /// The socket it is plugged into, such as "usb-0000:00:14.0-2.3": the controller, then the ports
  /// of each hub. Stays the same over restarts and replugging, unlike /dev/videoN.
  std::string bus_path;
  std::string serial;

  bool operator==(const UsbAddress&) const = default;
};

/// A device on the bus, as the kernel describes it.
struct UsbDevice {
  UsbAddress address;  ///< serial is empty where the device has none
  std::string product;
  int link_mbps = 0;  ///< 0 = unknown; 480 is USB 2, 5000 and more USB 3
  /// It says to follow USB 2.1 or later, as USB 3 devices do on a USB 2 link.
  bool could_be_faster = false;

  bool is_meant_by(const UsbAddress& address) const;
  /// "Depth Camera", serial 0001, at usb-0000:00:14.0-2.
  std::string text() const;
};

/// The device whose folder in sysfs is given (/sys/bus/usb/devices/1-2.3), or the nearest above the
/// folder; nothing if none is there. Reads a few small files; safe while the device leaves.
std::optional<UsbDevice> read_usb_device(const std::filesystem::path& folder);

}  // namespace instep
