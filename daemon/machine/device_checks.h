#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/devices/v4l2_settings.h"
#include "drivers/v4l2/video_nodes.h"

namespace instep {

/// Why a device cannot serve, with the command that mends it.
struct DeviceTrouble {
  std::string finding;
  std::string remedy;
  bool is_closed = false;  ///< it is that this user may not open it, which another may
};

/// Names the cause if the camera is not there, is in another's place, has no driver, may not be
/// opened by this user, or hangs on a slow link. Opens nothing.
std::optional<DeviceTrouble> trouble_of_camera(const V4l2Settings& camera,
                                               const DeviceFolders& folders);

/// The kernel's limit for all USB devices that programs drive themselves (16 MB) starves several
/// OpenNI2 sensors; nothing if it suffices for those that are plugged in.
std::optional<DeviceTrouble> trouble_of_usb_memory(const DeviceFolders& folders);

}  // namespace instep
