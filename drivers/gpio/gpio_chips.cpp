#include "drivers/gpio/gpio_chips.h"

#include <gpiod.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/gpio/gpio_chip.h"

namespace instep {
namespace {

std::vector<GpioLineState> lines_of(gpiod_chip* chip) {
  std::vector<GpioLineState> lines;
  for (unsigned offset = 0; offset < gpiod_chip_num_lines(chip); ++offset) {
    gpiod_line* const line = gpiod_chip_get_line(chip, offset);
    if (line == nullptr) continue;
    GpioLineState state{offset, text_or_empty(gpiod_line_name(line)),
                        text_or_empty(gpiod_line_consumer(line))};
    if (state.holder.empty() && gpiod_line_is_used(line)) state.holder = "the kernel";
    if (!state.name.empty() || !state.holder.empty()) lines.push_back(std::move(state));
  }
  return lines;
}

}  // namespace

std::vector<GpioChipState> list_gpio_chips(const std::filesystem::path& devices) {
  std::vector<GpioChipState> chips;
  const auto nodes = gpio_chip_nodes(devices);
  if (const int reason = nodes.failure.value(); fails_the_system(reason)) {
    chips.push_back({devices, {}, 0, {}, true, std::strerror(reason)});
  }
  for (const auto& node : nodes.paths) {
    GpioChipState state;
    state.node = node;
    if (const auto chip = open_gpio_chip(node)) {
      state.label = text_or_empty(gpiod_chip_label(chip.get()));
      state.line_count = gpiod_chip_num_lines(chip.get());
      state.lines = lines_of(chip.get());
    } else if (const int reason = errno; fails_the_system(reason)) {
      state.trouble = std::strerror(reason);
    } else if (reason == EACCES || reason == EPERM) {
      state.may_open = false;
    } else {
      continue;  // no chip, or one that has just left
    }
    chips.push_back(std::move(state));
  }
  return chips;
}

}  // namespace instep
