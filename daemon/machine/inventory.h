#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"
#include "drivers/evdev/input_nodes.h"
#include "drivers/gpio/gpio_chips.h"
#include "drivers/usb/usb_device.h"
#include "drivers/v4l2/video_modes.h"
#include "drivers/v4l2/video_nodes.h"

namespace instep {

/// A camera that is plugged in. The settings name it in `configured_as`; empty = they do not.
struct PluggedCamera {
  std::string kind;  ///< of the [[camera]] that would serve it: "v4l2" or "openni2"
  UsbDevice device;
  std::vector<std::filesystem::path> nodes;
  std::vector<VideoModes> modes;  ///< of V4L2 nodes that this user may open
  std::string configured_as;
};

/// What could serve a station and is plugged into this machine, configured or not.
struct Inventory {
  std::vector<PluggedCamera> cameras;
  std::vector<GpioChipState> gpio_chips;
  std::vector<InputNode> foot_switches;  ///< and other input devices with keys
};

/// Looks at the kernel's folders; opens video nodes and GPIO chips to ask them, and takes none.
Inventory take_inventory(const Settings& settings, const DeviceFolders& folders,
                         VideoSystem& system);

/// Whether the settings take this line, or this input device, for the pedal.
bool is_pedal(const PedalSettings& pedal, const GpioChipState& chip, const GpioLineState& line);
bool is_pedal(const PedalSettings& pedal, const InputNode& node);

/// Whether the device is a sensor that OpenNI2 serves through libusb, without a kernel driver.
bool is_openni_sensor(const std::string& usb_vendor);

}  // namespace instep
