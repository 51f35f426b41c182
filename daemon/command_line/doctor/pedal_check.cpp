#include "daemon/command_line/doctor/pedal_check.h"

#include <optional>

#include "daemon/command_line/doctor/closed_check.h"
#include "daemon/loop/event_loop.h"

namespace instep {
namespace {

/// Nothing if all is well.
std::optional<Error> trouble_of(const PedalSettings& settings, const PedalWatch::Open& open,
                                std::chrono::milliseconds patience) {
  const auto loop = EventLoop::create();
  if (!loop) return loop.error();
  std::optional<Error> trouble;
  PedalWatch watch(**loop, settings, open,
                   {[](PedalSignal) {},
                    [&](const Error& error) {
                      trouble = error;
                      (*loop)->leave();
                    },
                    [&] { (*loop)->leave(); }},
                   patience);
  if (const auto ran = (*loop)->run(); !ran) return ran.error();
  if (trouble) return trouble;
  const bool is_closed = watch.end_by(std::chrono::steady_clock::now() + patience);
  return is_closed ? std::nullopt : std::optional(silent_pedal());
}

}  // namespace

DoctorCheck check_pedal(const PedalSettings& settings, const PedalWatch::Open& open,
                        std::chrono::milliseconds patience) {
  const auto trouble = trouble_of(settings, open, patience);
  return trouble ? failed_check("pedal", *trouble) : good_check("pedal", "can be opened");
}

}  // namespace instep
