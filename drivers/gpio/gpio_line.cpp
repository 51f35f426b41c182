#include "drivers/gpio/gpio_line.h"

#include <fmt/format.h>
#include <gpiod.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "drivers/files/system_user.h"

namespace instep {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> not_looked_at(const fs::path& node, int reason) {
  return fail(ErrorCode::kIo,
              fmt::format("{} cannot be opened: {}", node.string(), std::strerror(reason)),
              "check the limits on open files and memory");
}

tl::unexpected<Error> not_found(const std::string& line, const std::vector<fs::path>& chips) {
  // The same of every line: one cause, which a board with several of them has to say but once.
  if (chips.empty()) {
    return fail(ErrorCode::kNotFound, "there is no GPIO chip, and so none of its lines",
                "plug in the board that has them, and see whether gpiodetect lists it");
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

gpiod_line* GpioLine::line_of(gpiod_chip* chip, const GpioLineAddress& address) {
  if (!address.chip.empty() && address.chip != text_or_empty(gpiod_chip_label(chip)))
    return nullptr;
  if (!address.line.empty()) return gpiod_chip_find_line(chip, address.line.c_str());
  if (!address.offset || *address.offset >= gpiod_chip_num_lines(chip)) return nullptr;
  return gpiod_chip_get_line(chip, *address.offset);
}

Result<GpioLine> GpioLine::find(const GpioLineAddress& address, const fs::path& devices) {
  if (address.line.empty() && (address.chip.empty() || !address.offset)) {
    return fail(ErrorCode::kInvalidInput, "a GPIO line without a name",
                "name the line, or its chip's label and its offset");
  }
  const auto nodes = gpio_chip_nodes(devices);
  if (fails_the_system(nodes.failure.value())) {
    return not_looked_at(devices, nodes.failure.value());
  }
  std::optional<GpioLine> found;
  std::string closed;  // the last chip that this user may not open
  for (const auto& path : nodes.paths) {
    auto chip = open_gpio_chip(path);
    if (!chip) {
      const int reason = errno;
      if (fails_the_system(reason)) return not_looked_at(path, reason);
      if (reason == EACCES || reason == EPERM) closed = path.string();
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
                command_to_join("plugdev") + ", where the udev rules of Instep are installed");
  }
  return not_found(address.text(), nodes.paths);
}

Result<void> GpioLine::check_free() const {
  if (!gpiod_line_is_used(line_)) return {};
  return tl::make_unexpected(request_failure(EBUSY));
}

Error GpioLine::request_failure(int reason) const {
  const std::string chip = gpiod_chip_name(chip_.get());
  if (reason == EBUSY) {
    // Who holds it is known since the line was found, unless he came just now.
    gpiod_line_update(line_);
    const std::string holder = text_or_empty(gpiod_line_consumer(line_));
    return {ErrorCode::kBusy, Remedy::kOperator,
            fmt::format("{} ({}) is held by {}", text_, chip,
                        holder.empty() ? "somebody without a name" : '"' + holder + '"'),
            "sudo lsof | grep gpio shows which program it is: end it, or free the line in sysfs"};
  }
  const auto code = reason == ENODEV                      ? ErrorCode::kDeviceGone
                    : reason == EACCES || reason == EPERM ? ErrorCode::kPermissionDenied
                                                          : ErrorCode::kIo;
  return {code, usual_remedy(code),
          fmt::format("{} ({}) cannot be used: {}", text_, chip, std::strerror(reason)),
          "see whether gpiomon can read it"};
}

}  // namespace instep
