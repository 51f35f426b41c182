#include "drivers/gpio/gpio_chips.h"

#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

namespace instep {
namespace {

namespace fs = std::filesystem;

std::string or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

std::vector<GpioLineState> lines_of(gpiod_chip* chip) {
  std::vector<GpioLineState> lines;
  for (unsigned offset = 0; offset < gpiod_chip_num_lines(chip); ++offset) {
    gpiod_line* const line = gpiod_chip_get_line(chip, offset);
    if (line == nullptr) continue;
    GpioLineState state{offset, or_empty(gpiod_line_name(line)),
                        or_empty(gpiod_line_consumer(line))};
    if (state.holder.empty() && gpiod_line_is_used(line)) state.holder = "the kernel";
    if (!state.name.empty() || !state.holder.empty()) lines.push_back(std::move(state));
  }
  return lines;
}

}  // namespace

std::vector<GpioChipState> list_gpio_chips(const fs::path& devices) {
  std::vector<GpioChipState> chips;
  std::error_code unreadable;
  for (auto entry = fs::directory_iterator(devices, unreadable);
       !unreadable && entry != fs::end(entry); entry.increment(unreadable)) {
    if (!entry->path().filename().native().starts_with("gpiochip")) continue;
    GpioChipState state;
    state.node = entry->path();
    const std::unique_ptr<gpiod_chip, void (*)(gpiod_chip*)> chip(
        gpiod_chip_open(state.node.c_str()), gpiod_chip_close);
    if (chip) {
      state.label = or_empty(gpiod_chip_label(chip.get()));
      state.line_count = gpiod_chip_num_lines(chip.get());
      state.lines = lines_of(chip.get());
    } else if (errno == EACCES || errno == EPERM) {
      state.may_open = false;
    } else {
      continue;  // no chip, or one that has just left
    }
    chips.push_back(std::move(state));
  }
  std::sort(chips.begin(), chips.end(),
            [](const auto& a, const auto& b) { return a.node < b.node; });
  return chips;
}

}  // namespace instep
