#pragma once

#include <optional>
#include <string>

namespace instep {

class SettingsFaults;
class SettingsTable;

enum class PedalBias { kPullUp, kPullDown, kNone };

/// A pedal on a GPIO line, the table [pedal.gpio]. Chips are never told by their number, which
/// another kernel changes.
struct GpioPedalSettings {
  std::string line;           ///< the line's name; empty = chip and offset; at most 31 characters
  std::string chip;           ///< the chip's label; may be empty if the line's name is unique
  std::optional<int> offset;  ///< of a line without a name, 0 to 1023
  bool active_low = true;     ///< pressed means a low level: a contact to ground
  PedalBias bias = PedalBias::kPullUp;
};

/// A USB foot switch that acts as a keyboard, the table [pedal.evdev].
struct EvdevPedalSettings {
  std::string device;  ///< "0c45:7403", or its name in /dev/input/by-id; at most 128 characters
  std::string key;     ///< as the kernel calls it, such as "KEY_B"; at most 32 characters
};

void read_gpio_pedal(SettingsTable& table, GpioPedalSettings& gpio);
void read_evdev_pedal(SettingsTable& table, EvdevPedalSettings& evdev);

/// Leaves a fault at `line` if the settings do not say which line, or which key of what device.
void check_gpio_pedal(const GpioPedalSettings& gpio, unsigned line, SettingsFaults& faults);
void check_evdev_pedal(const EvdevPedalSettings& evdev, unsigned line, SettingsFaults& faults);

/// Such as `GPIO line "foot" of the chip "board", active low, pulled up`.
std::string describe(const GpioPedalSettings& gpio);
std::string describe(const EvdevPedalSettings& evdev);

}  // namespace instep
