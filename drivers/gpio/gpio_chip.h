#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "drivers/files/folder_entries.h"

struct gpiod_chip;

namespace instep {

struct CloseGpioChip {
  void operator()(gpiod_chip* chip) const;
};

/// An open chip of libgpiod; closing it releases its lines.
using GpioChipHandle = std::unique_ptr<gpiod_chip, CloseGpioChip>;

/// Null, with errno, if it cannot be opened.
GpioChipHandle open_gpio_chip(const std::filesystem::path& node);

/// Whether that is trouble of the system, and not of a chip that has just left, a node that is none
/// or a user who may not.
bool fails_the_system(int reason);

/// The nodes of chips in `devices` (/dev), by name. libgpiod's own search gives up at the first
/// chip that this user may not open.
FolderEntries gpio_chip_nodes(const std::filesystem::path& devices);

/// What libgpiod says of names: null where there is none.
std::string text_or_empty(const char* text);

}  // namespace instep
