#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/devices/gpio_place.h"

namespace instep {

class SettingsFaults;
class SettingsTable;

/// A GPIO line that the station switches.
struct GpioOutputSettings {
  GpioPlace place;
  bool active_low = false;  ///< on means a low level
};

/// What the station shows and lights by GPIO lines, each of them if it is there: the tables
/// [lamp.ready], [lamp.busy], [lamp.fault] and [projector]. A station with one lamp has it at
/// lamp.ready: it is lit while the pedal starts a scan and nothing is wrong.
struct OutputSettings {
  std::optional<GpioOutputSettings> ready_lamp;
  std::optional<GpioOutputSettings> busy_lamp;
  std::optional<GpioOutputSettings> fault_lamp;
  /// On from the start of a capture to its end. The cameras run free and none of them waits for a
  /// light, so that a pulse at the start would be over before the frames that count: what warms
  /// up has to warm up in the light, and up to a second of frames is averaged after that.
  std::optional<GpioOutputSettings> projector;

  struct Named {
    const char* name;  ///< of its table
    const GpioOutputSettings* output;
  };
  /// Those that are there.
  std::vector<Named> named() const;
};

/// Reads the tables of `root`, and leaves a fault where one of them, or `pedal` (null if there
/// is none without a fault), names the line of another.
void read_outputs(SettingsTable& root, OutputSettings& outputs, const GpioPlace* pedal,
                  SettingsFaults& faults);

/// Such as `GPIO line "green", active high`.
std::string describe(const GpioOutputSettings& output);

}  // namespace instep
