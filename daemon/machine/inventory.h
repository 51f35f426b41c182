#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "config/settings.h"
#include "drivers/evdev/input_nodes.h"
#include "drivers/gpio/gpio_chips.h"
#include "drivers/openni2/openni_program.h"
#include "drivers/usb/usb_device.h"
#include "drivers/v4l2/video_modes.h"
#include "drivers/v4l2/video_nodes.h"

namespace instep {

/// A camera that is plugged in. The settings name it in `configured_as`; empty = they do not.
struct PluggedCamera {
  std::string kind;  ///< of the [[camera]] that would serve it: "v4l2" or "openni2"
  /// Its serial is the one that the settings want: OpenNI2's own, where OpenNI2 tells it, which is
  /// not always that of the USB descriptor. No bus_path = not on USB.
  UsbDevice device;
  std::vector<std::filesystem::path> nodes;
  std::vector<VideoModes> modes;  ///< as far as this user may open the device
  std::string configured_as;
  std::string trouble;  ///< why OpenNI2 cannot open it now, or a driver lists no modes; or empty
};

/// What could serve a station and is plugged into this machine, configured or not.
struct Inventory {
  std::vector<PluggedCamera> cameras;
  std::vector<GpioChipState> gpio_chips;
  std::vector<InputNode> foot_switches;  ///< and other input devices with keys
  std::vector<Error> openni_troubles;    ///< why OpenNI2 did not list its sensors
};

/// What OpenNI2 sees by itself, through the system's library and each of the settings' own.
struct OpenniSight {
  std::vector<OpenniDevice> sensors;
  std::vector<Error> troubles;
};
/// Opens each sensor that is not in use for a moment. Takes as long as list_openni_devices() for
/// each library, at most `limit` each.
OpenniSight look_through_openni(const Settings& settings, const std::filesystem::path& program,
                                std::chrono::milliseconds limit);

/// Puts what OpenNI2 sees together with the kernel's folders; opens video nodes and GPIO chips to
/// ask them, and takes none.
Inventory take_inventory(const Settings& settings, const DeviceFolders& folders,
                         VideoSystem& system, const OpenniSight& openni);

/// What the settings take this line for: "pedal", "lamp.ready", "projector"; empty = nothing.
std::string use_of_line(const Settings& settings, const GpioChipState& chip,
                        const GpioLineState& line);
/// Whether the settings take this input device for the pedal.
bool is_pedal(const PedalSettings& pedal, const InputNode& node);

/// Whether the device is a sensor that OpenNI2 serves through libusb, without a kernel driver.
bool is_openni_sensor(const std::string& usb_vendor);

}  // namespace instep
