#include "drivers/gpio/gpio_chip.h"

#include <gpiod.h>

#include <cerrno>

namespace instep {

namespace fs = std::filesystem;

void CloseGpioChip::operator()(gpiod_chip* chip) const {
  gpiod_chip_close(chip);
}

GpioChipHandle open_gpio_chip(const fs::path& node) {
  return GpioChipHandle(gpiod_chip_open(node.c_str()));
}

bool fails_the_system(int reason) {
  return reason == EMFILE || reason == ENFILE || reason == ENOMEM || reason == EIO;
}

FolderEntries gpio_chip_nodes(const fs::path& devices) {
  return entries_of(devices, "gpiochip");
}

std::string text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

}  // namespace instep
