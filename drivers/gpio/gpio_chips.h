#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace instep {

/// A line worth showing: one that has a name or a user.
struct GpioLineState {
  unsigned offset = 0;
  std::string name;    ///< empty if it has none
  std::string holder;  ///< who uses it, as he called himself; empty if it is free
};

/// A GPIO chip with its lines as they are now.
struct GpioChipState {
  std::filesystem::path node;  ///< such as /dev/gpiochip0: this number changes
  std::string label;
  unsigned line_count = 0;
  std::vector<GpioLineState> lines;
  bool may_open = true;  ///< if this user may not, the rest is unknown
  std::string trouble;   ///< of the system, which opens none now; the rest is unknown then too
};

/// The chips of `devices`, by name; where that itself cannot be read, it stands for them with its
/// trouble. Requests no line.
std::vector<GpioChipState> list_gpio_chips(const std::filesystem::path& devices = "/dev");

}  // namespace instep
