#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "config/settings.h"
#include "daemon/station/devices.h"
#include "drivers/depth_camera.h"
#include "drivers/usb/usb_device.h"

namespace instep {

/// One that could be opened when another could not, and where it was on USB then: it may have left
/// meanwhile, and is to be noticed when it comes back.
struct OpenSensor {
  std::unique_ptr<DepthCamera> camera;
  std::optional<UsbAddress> usb;
};

/// The OpenNI2 sensors that stay open from an attempt to open all devices that failed to the next,
/// by the names that the settings give them. For one thread at a time.
class OpenSensors {
 public:
  /// Those among the devices, in place of what was kept before; of two sources of one name one.
  void keep(const Settings& settings, Devices devices);
  /// Nothing if none of that name is kept, or it was taken before.
  std::optional<OpenSensor> take(const std::string& name);
  /// Closes them.
  void clear() { sensors_.clear(); }

 private:
  std::map<std::string, OpenSensor> sensors_;
};

}  // namespace instep
