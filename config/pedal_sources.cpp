#include "config/pedal_sources.h"

#include <fmt/format.h>

#include "config/settings_table.h"

namespace instep {

void read_gpio_pedal(SettingsTable& table, GpioPedalSettings& gpio) {
  table.read("line", gpio.line, 31);
  table.read("chip", gpio.chip, 31);
  constexpr int kUnsaid = -1;
  int offset = kUnsaid;
  table.read("offset", offset, 0, 1023);
  if (offset != kUnsaid) gpio.offset = offset;
  table.choose("active", gpio.active_low, {{"low", true}, {"high", false}});
  table.choose("bias", gpio.bias,
               {{"pull-up", PedalBias::kPullUp},
                {"pull-down", PedalBias::kPullDown},
                {"none", PedalBias::kNone}});
}

void read_evdev_pedal(SettingsTable& table, EvdevPedalSettings& evdev) {
  table.read("device", evdev.device, 128);
  table.read("key", evdev.key, 32);
}

void check_gpio_pedal(const GpioPedalSettings& gpio, unsigned line, SettingsFaults& faults) {
  if (gpio.line.empty() && (gpio.chip.empty() || !gpio.offset)) {
    faults.add(line,
               "pedal.gpio.line is missing: name the line, or say pedal.gpio.chip (its label) and "
               "pedal.gpio.offset, as gpioinfo shows them");
  } else if (!gpio.line.empty() && gpio.offset) {
    faults.add(line, "pedal.gpio has a line and an offset: say one of them");
  }
}

void check_evdev_pedal(const EvdevPedalSettings& evdev, unsigned line, SettingsFaults& faults) {
  if (evdev.device.empty()) {
    faults.add(line,
               "pedal.evdev.device is missing: write its USB ids, such as \"0c45:7403\", or its "
               "name in /dev/input/by-id");
  }
  if (evdev.key.empty()) {
    faults.add(
        line,
        "pedal.evdev.key is missing: write what evtest shows when the pedal is pressed, such "
        "as \"KEY_B\"");
  }
}

std::string describe(const GpioPedalSettings& gpio) {
  const std::string chip = gpio.chip.empty() ? "" : fmt::format(" of the chip \"{}\"", gpio.chip);
  const char* const bias = gpio.bias == PedalBias::kPullUp     ? "pulled up"
                           : gpio.bias == PedalBias::kPullDown ? "pulled down"
                                                               : "without bias";
  return fmt::format(
      "GPIO line {}{}, active {}, {}",
      gpio.line.empty() ? std::to_string(gpio.offset.value_or(0)) : '"' + gpio.line + '"', chip,
      gpio.active_low ? "low" : "high", bias);
}

std::string describe(const EvdevPedalSettings& evdev) {
  return fmt::format("{} of the input device {}", evdev.key, evdev.device);
}

}  // namespace instep
