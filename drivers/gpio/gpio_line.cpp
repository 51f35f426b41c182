#include "drivers/gpio/gpio_line.h"

#include <fmt/format.h>
#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

namespace instep {
namespace {

namespace fs = std::filesystem;

const char* or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

std::vector<fs::path> chips_in(const fs::path& devices) {
  std::vector<fs::path> chips;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(devices, unreadable)) {
    if (entry.path().filename().native().starts_with("gpiochip")) chips.push_back(entry.path());
  }
  std::sort(chips.begin(), chips.end());
  return chips;
}

tl::unexpected<Error> not_found(const std::string& line, const std::vector<fs::path>& chips) {
  if (chips.empty()) {
    return fail(ErrorCode::kNotFound, "there is no GPIO chip, so no " + line,
                "plug in the board that has it, and see whether gpiodetect lists it");
  }
  return fail(ErrorCode::kNotFound, fmt::format("none of {} GPIO chips has {}", chips.size(), line),
              "gpioinfo lists the names and labels there are");
}

}  // namespace

std::string GpioLineAddress::text() const {
  const std::string of_chip = chip.empty() ? "" : fmt::format(" of the chip \"{}\"", chip);
  if (!line.empty()) return fmt::format("line \"{}\"{}", line, of_chip);
  return fmt::format("line {}{}", offset.value_or(0), of_chip);
}

void GpioLine::CloseChip::operator()(gpiod_chip* chip) const {
  gpiod_chip_close(chip);
}

gpiod_line* GpioLine::line_of(gpiod_chip* chip, const GpioLineAddress& address) {
  if (!address.chip.empty() && address.chip != or_empty(gpiod_chip_label(chip))) return nullptr;
  if (!address.line.empty()) return gpiod_chip_find_line(chip, address.line.c_str());
  if (!address.offset || *address.offset >= gpiod_chip_num_lines(chip)) return nullptr;
  return gpiod_chip_get_line(chip, *address.offset);
}

Result<GpioLine> GpioLine::find(const GpioLineAddress& address, const fs::path& devices) {
  if (address.line.empty() && (address.chip.empty() || !address.offset)) {
    return fail(ErrorCode::kInvalidInput, "a GPIO line without a name",
                "name the line, or its chip's label and its offset");
  }
  const auto paths = chips_in(devices);
  std::optional<GpioLine> found;
  std::string closed;  // the last chip that this user may not open
  for (const auto& path : paths) {
    Chip chip(gpiod_chip_open(path.c_str()));
    if (chip == nullptr) {
      if (errno == EACCES || errno == EPERM) closed = path.string();
      continue;
    }
    gpiod_line* line = line_of(chip.get(), address);
    if (line == nullptr) continue;
    if (found) {
      return fail(ErrorCode::kInvalidInput,
                  fmt::format("two GPIO chips have {}: {} and {}", address.text(),
                              gpiod_chip_name(found->chip_.get()), gpiod_chip_name(chip.get())),
                  "say the chip's label as well, or another label");
    }
    found = GpioLine(std::move(chip), line, address.text());
  }
  if (found) return std::move(*found);
  if (!closed.empty()) {
    return fail(ErrorCode::kPermissionDenied, "this user may not open " + closed,
                "install the udev rules of Instep, and be of the group plugdev");
  }
  return not_found(address.text(), paths);
}

Error GpioLine::request_failure(int reason) const {
  const std::string chip = gpiod_chip_name(chip_.get());
  if (reason == EBUSY) {
    // Who holds it is known since the line was found, unless he came just now.
    gpiod_line_update(line_);
    const std::string holder = or_empty(gpiod_line_consumer(line_));
    return {ErrorCode::kBusy, Remedy::kOperator,
            fmt::format("{} ({}) is held by {}", text_, chip,
                        holder.empty() ? "somebody without a name" : '"' + holder + '"'),
            "end that program, or free the line in the device tree or in sysfs"};
  }
  const auto code = reason == ENODEV                      ? ErrorCode::kDeviceGone
                    : reason == EACCES || reason == EPERM ? ErrorCode::kPermissionDenied
                                                          : ErrorCode::kIo;
  return {code, usual_remedy(code),
          fmt::format("{} ({}) cannot be used: {}", text_, chip, std::strerror(reason)),
          "see whether gpiomon can read it"};
}

}  // namespace instep
