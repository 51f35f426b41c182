#pragma once

#include <string>

#include "config/devices/gpio_place.h"

namespace instep {

class SettingsFaults;
class SettingsTable;

enum class PedalBias { kPullUp, kPullDown, kNone };

/// A pedal on a GPIO line, the table [pedal.gpio].
struct GpioPedalSettings {
  GpioPlace place;
  bool active_low = true;  ///< pressed means a low level: a contact to ground
  PedalBias bias = PedalBias::kPullUp;
};

/// A USB foot switch that acts as a keyboard, the table [pedal.evdev].
struct EvdevPedalSettings {
  std::string device;  ///< "0c45:7403", or its name in /dev/input/by-id; at most 128 characters
  std::string key;     ///< as the kernel calls it, such as "KEY_B"; at most 32 characters
};

void read_gpio_pedal(SettingsTable& table, GpioPedalSettings& gpio);
void read_evdev_pedal(SettingsTable& table, EvdevPedalSettings& evdev);

/// Leaves a fault if the table does not say which key of what device.
void require_evdev_pedal(const SettingsTable& table, SettingsFaults& faults);

/// The fault of a [pedal.evdev] that is not there.
std::string evdev_device_missing();

/// Such as `GPIO line "foot" of the chip "board", active low, pulled up`.
std::string describe(const GpioPedalSettings& gpio);
std::string describe(const EvdevPedalSettings& evdev);

}  // namespace instep
