#include "config/devices/pedal_sources.h"

#include <fmt/format.h>

#include "config/reading/settings_table.h"

namespace instep {

void read_gpio_pedal(SettingsTable& table, GpioPedalSettings& gpio) {
  read_gpio_place(table, gpio.place);
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

void require_evdev_pedal(const SettingsTable& table, SettingsFaults& faults) {
  if (!table.has("device")) faults.add(table.line(), evdev_device_missing());
  if (!table.has("key")) {
    faults.add(
        table.line(),
        "pedal.evdev.key is missing: write what evtest shows when the pedal is pressed, such "
        "as \"KEY_B\"");
  }
}

std::string evdev_device_missing() {
  return "pedal.evdev.device is missing: write its USB ids, such as \"0c45:7403\", or its name in "
         "/dev/input/by-id";
}

std::string describe(const GpioPedalSettings& gpio) {
  const char* const bias = gpio.bias == PedalBias::kPullUp     ? "pulled up"
                           : gpio.bias == PedalBias::kPullDown ? "pulled down"
                                                               : "without bias";
  return fmt::format("{}, active {}, {}", describe(gpio.place), gpio.active_low ? "low" : "high",
                     bias);
}

std::string describe(const EvdevPedalSettings& evdev) {
  return fmt::format("{} of the input device {}", evdev.key, evdev.device);
}

}  // namespace instep
