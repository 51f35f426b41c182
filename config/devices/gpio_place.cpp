#include "config/devices/gpio_place.h"

#include <fmt/format.h>

#include "config/reading/settings_table.h"

namespace instep {

bool GpioPlace::is_same_line(const GpioPlace& other) const {
  const bool chips_differ = !chip.empty() && !other.chip.empty() && chip != other.chip;
  if (chips_differ || line != other.line) return false;
  return !line.empty() || offset == other.offset;
}

bool GpioPlace::is(const std::string& chip_label, const std::string& line_name,
                   unsigned line_offset) const {
  if (!chip.empty() && chip != chip_label) return false;
  if (!line.empty()) return line == line_name;
  return offset && static_cast<unsigned>(*offset) == line_offset;
}

void read_gpio_place(SettingsTable& table, GpioPlace& place) {
  table.read("line", place.line, 31);
  table.read("chip", place.chip, 31);
  int offset = 0;
  table.read("offset", offset, 0, 1023);
  if (table.has("offset")) place.offset = offset;
}

void require_gpio_place(const SettingsTable& table, SettingsFaults& faults) {
  if (!table.has("line") && !(table.has("chip") && table.has("offset"))) {
    faults.add(table.line(), gpio_place_missing(table.name()));
  } else if (table.has("line") && table.has("offset")) {
    faults.add(table.line(), table.name() + " has a line and an offset: say one of them");
  }
}

std::string gpio_place_missing(const std::string& table) {
  return fmt::format(
      "{0}.line is missing: name the line, or say {0}.chip (its label) and {0}.offset, as gpioinfo "
      "shows them",
      table);
}

std::string describe(const GpioPlace& place) {
  const std::string chip = place.chip.empty() ? "" : fmt::format(" of the chip \"{}\"", place.chip);
  const std::string line =
      place.line.empty() ? std::to_string(place.offset.value_or(0)) : '"' + place.line + '"';
  return fmt::format("GPIO line {}{}", line, chip);
}

}  // namespace instep
