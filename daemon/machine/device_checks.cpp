#include "daemon/machine/device_checks.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "daemon/machine/inventory.h"
#include "drivers/files/system_user.h"
#include "drivers/usb/sysfs.h"
#include "drivers/usb/usb_devices.h"

namespace instep {
namespace {

/// A camera that no video node stands for.
DeviceTrouble trouble_of_absent(const V4l2Settings& camera, const Error& error,
                                const DeviceFolders& folders) {
  const UsbAddress wanted{camera.bus_path, camera.serial};
  for (const auto& plugged : list_usb_devices(folders.sysfs, folders.dev)) {
    if (plugged.device.is_meant_by(wanted)) {
      return {plugged.device.text() + " is plugged in, but no driver serves it as a video node",
              "sudo modprobe uvcvideo"};
    }
    const auto& address = plugged.device.address;
    if (!camera.serial.empty() && camera.serial == address.serial) {
      return {
          fmt::format("it is plugged into {}, not into {}", address.bus_path, camera.bus_path),
          fmt::format("plug it into its own socket, or set bus_path = \"{}\"", address.bus_path)};
    }
  }
  return {error.message, error.advice};
}

}  // namespace

std::optional<DeviceTrouble> trouble_of_camera(const V4l2Settings& camera,
                                               const DeviceFolders& folders) {
  const auto nodes = find_video_nodes({camera.bus_path, camera.serial}, folders);
  if (!nodes && nodes.error().code == ErrorCode::kDeviceGone) {
    return trouble_of_absent(camera, nodes.error(), folders);
  }
  if (!nodes) return DeviceTrouble{nodes.error().message, nodes.error().advice};
  for (const auto& node : *nodes) {
    if (::access(node.path.c_str(), R_OK | W_OK) == 0) continue;
    const bool denied = errno == EACCES;
    return DeviceTrouble{
        fmt::format("{} cannot be opened: {}", node.path.string(), std::strerror(errno)),
        denied ? command_to_join("video") + ", then log in again" : "sudo udevadm trigger", denied};
  }
  const auto& device = nodes->front().device;
  if (device.could_be_faster) {
    return DeviceTrouble{
        fmt::format("{} is a USB 3 camera on a link of {} Mbit/s", device.text(), device.link_mbps),
        "plug it into a USB 3 socket with a USB 3 cable, then: instep devices"};
  }
  return std::nullopt;
}

std::optional<DeviceTrouble> trouble_of_usb_memory(const DeviceFolders& folders) {
  constexpr int kMegabytesEach = 16;
  const auto devices = list_usb_devices(folders.sysfs, folders.dev);
  const auto sensors = std::count_if(devices.begin(), devices.end(), [](const auto& plugged) {
    return is_openni_sensor(plugged.vendor);
  });
  const auto file = folders.sysfs / "module/usbcore/parameters/usbfs_memory_mb";
  const std::string text = sysfs_line(file);
  int limit = 0;
  const bool known =
      std::from_chars(text.data(), text.data() + text.size(), limit).ec == std::errc();
  const auto needed = kMegabytesEach * sensors;
  // A limit of 0 is none.
  if (!known || limit == 0 || limit >= needed) return std::nullopt;
  return DeviceTrouble{
      fmt::format("{} MB of memory for {} OpenNI2 sensors on USB is too little", limit, sensors),
      fmt::format("echo {} | sudo tee {}; for good: usbcore.usbfs_memory_mb={} on the kernel's "
                  "command line",
                  needed, file.string(), needed)};
}

}  // namespace instep
