#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/usb/usb_device.h"

namespace instep {

/// A /dev/videoN, whose N changes from plug to plug, with what does not change.
struct VideoNode {
  std::filesystem::path path;
  std::string name;  ///< as the driver calls it
  UsbDevice device;
};

/// Where the kernel shows its devices; other folders in tests.
struct DeviceFolders {
  std::filesystem::path sysfs = "/sys";
  std::filesystem::path dev = "/dev";
};

/// All video nodes of USB devices, by N.
std::vector<VideoNode> list_video_nodes(const DeviceFolders& folders);

/// The nodes of the one device that is meant; a camera has one for each of its streams. Fails with
/// kDeviceGone, saying what is there instead, and with kInvalidInput if several devices fit, as
/// those do whose maker gave all the same serial number.
Result<std::vector<VideoNode>> find_video_nodes(const UsbAddress& wanted,
                                                const DeviceFolders& folders);

}  // namespace instep
