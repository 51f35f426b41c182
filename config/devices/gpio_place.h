#pragma once

#include <optional>
#include <string>

namespace instep {

class SettingsFaults;
class SettingsTable;

/// Where a GPIO line is. Chips are never told by their number, which another kernel changes.
struct GpioPlace {
  std::string line;           ///< the line's name; empty = chip and offset; at most 31 characters
  std::string chip;           ///< the chip's label; may be empty if the line's name is unique
  std::optional<int> offset;  ///< of a line without a name, 0 to 1023

  /// As far as the settings tell: a line may be named once and counted once.
  bool is_same_line(const GpioPlace& other) const;
  /// Whether it means this line, as the kernel calls it.
  bool is(const std::string& chip_label, const std::string& line_name, unsigned line_offset) const;
};

void read_gpio_place(SettingsTable& table, GpioPlace& place);

/// Leaves a fault if the table does not say which line. What it says wrongly has a fault of its own
/// already, and is not missing.
void require_gpio_place(const SettingsTable& table, SettingsFaults& faults);

/// The fault of a table that is not there, or says nothing; `table` is its name, "pedal.gpio".
std::string gpio_place_missing(const std::string& table);

/// Such as `GPIO line "foot" of the chip "board"`.
std::string describe(const GpioPlace& place);

}  // namespace instep
