#include "drivers/gpio/gpio_output.h"

#include <gpiod.h>

#include <cerrno>

namespace instep {

Result<std::unique_ptr<GpioOutput>> GpioOutput::open(const Settings& settings) {
  auto line = GpioLine::find(settings.address, settings.devices);
  if (!line) return tl::make_unexpected(line.error());
  constexpr int kOff = 0;
  const int flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (gpiod_line_request_output_flags(line->get(), "instep output", flags, kOff) != 0) {
    return tl::make_unexpected(line->request_failure(errno));
  }
  return std::unique_ptr<GpioOutput>(new GpioOutput(std::move(*line)));
}

GpioOutput::~GpioOutput() {
  // Fails only where the chip has left.
  gpiod_line_set_value(line_.get(), 0);
}

Result<void> GpioOutput::set(bool on) {
  if (gpiod_line_set_value(line_.get(), on ? 1 : 0) == 0) return {};
  if (const int reason = errno; reason != ENODEV) {
    return tl::make_unexpected(line_.request_failure(reason));
  }
  return fail(ErrorCode::kDeviceGone, "the GPIO chip of an output left", "plug its board in again");
}

}  // namespace instep
