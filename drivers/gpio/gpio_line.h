#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/result.h"
#include "drivers/gpio/gpio_chip.h"

struct gpiod_line;

namespace instep {

/// Where a line is, said so that it stays true: chips are numbered in the order in which they are
/// found, which another kernel or another plug changes. So a line is told by its name, or by its
/// chip's label and its offset there, as `gpioinfo` shows them.
struct GpioLineAddress {
  std::string line;  ///< the line's name; empty if it is told by its offset
  std::string chip;  ///< the chip's label; with a name it is needed only if two lines share it
  std::optional<unsigned> offset;  ///< of a line without a name

  /// Such as `line "pedal"` or `line 17 of the chip "pinctrl-bcm2711"`.
  std::string text() const;
};

/// A line of a GPIO chip that is there, by libgpiod 1.6. Releases the line and closes the chip at
/// the end.
class GpioLine {
 public:
  /// Looks through the chips of `devices`, which takes about a millisecond each. Fails with
  /// kNotFound if the line is not there, kPermissionDenied if a chip that may have it cannot be
  /// opened, kIo if the system fails at looking, kInvalidInput if several lines answer to the
  /// address.
  static Result<GpioLine> find(const GpioLineAddress& address,
                               const std::filesystem::path& devices = "/dev");

  gpiod_line* get() const { return line_; }

  /// Fails with kBusy if somebody uses it, and names him. Takes nothing.
  Result<void> check_free() const;

  /// Why requesting or setting it failed just now (errno): kBusy names who holds it.
  Error request_failure(int reason) const;

 private:
  GpioLine(GpioChipHandle chip, gpiod_line* line, std::string text)
      : chip_(std::move(chip)), line_(line), text_(std::move(text)) {}
  static gpiod_line* line_of(gpiod_chip* chip, const GpioLineAddress& address);

  GpioChipHandle chip_;
  gpiod_line* line_;  ///< owned by the chip
  std::string text_;
};

}  // namespace instep
