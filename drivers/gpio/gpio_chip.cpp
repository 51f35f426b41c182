#include "drivers/gpio/gpio_chip.h"

#include <gpiod.h>

#include <algorithm>
#include <system_error>

namespace instep {

namespace fs = std::filesystem;

void CloseGpioChip::operator()(gpiod_chip* chip) const {
  gpiod_chip_close(chip);
}

GpioChipHandle open_gpio_chip(const fs::path& node) {
  return GpioChipHandle(gpiod_chip_open(node.c_str()));
}

std::vector<fs::path> gpio_chip_nodes(const fs::path& devices) {
  std::vector<fs::path> nodes;
  std::error_code unreadable;
  for (auto entry = fs::directory_iterator(devices, unreadable);
       !unreadable && entry != fs::end(entry); entry.increment(unreadable)) {
    if (entry->path().filename().native().starts_with("gpiochip")) nodes.push_back(entry->path());
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

}  // namespace instep
