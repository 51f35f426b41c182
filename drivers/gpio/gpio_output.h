#pragma once

#include <filesystem>
#include <memory>
#include <utility>

#include "drivers/gpio/gpio_line.h"
#include "drivers/output_line.h"

namespace instep {

/// An output on a GPIO line. A program that is killed cannot put its lines off: most chips then
/// hold their level until somebody takes the line again.
class GpioOutput final : public OutputLine {
 public:
  struct Settings {
    GpioLineAddress address;
    bool active_low = false;  ///< on means a low level
    std::filesystem::path devices = "/dev";
  };

  /// Fails as GpioLine::find does, and with kBusy (the message names the holder) if the line is in
  /// use. Worth another try later.
  static Result<std::unique_ptr<GpioOutput>> open(const Settings& settings);

  ~GpioOutput() override;
  GpioOutput(const GpioOutput&) = delete;
  GpioOutput& operator=(const GpioOutput&) = delete;

  Result<void> set(bool on) override;

 private:
  explicit GpioOutput(GpioLine line) : line_(std::move(line)) {}

  GpioLine line_;
};

}  // namespace instep
