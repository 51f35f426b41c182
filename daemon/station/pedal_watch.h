#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/station/back_off.h"
#include "daemon/station/pedal_debouncer.h"
#include "drivers/pedal.h"

namespace instep {

/// The trouble that the signals of these names stand for.
Error stuck_pedal();
Error chattering_pedal();

/// A pedal on the event loop: reads its edges, lets the debouncer judge them, opens it again when
/// it was lost. Lives on the loop's thread.
class PedalWatch {
 public:
  /// What the owner is told.
  struct Listener {
    std::function<void(PedalSignal)> on_signal;
    std::function<void(const Error&)> on_lost;  ///< and again when the cause is another one
    std::function<void()> on_returned;
  };
  /// Opens the pedal; asked again with growing pauses as long as it fails.
  using Open = std::function<Result<std::unique_ptr<Pedal>>()>;

  PedalWatch(EventLoop& loop, const PedalSettings& settings, Open open, Listener listener);

  /// New times hold at once, for a press that is under way too.
  void set(const PedalSettings& settings);

 private:
  void open();
  void begin();
  void read();
  void settle();
  void pass_on();
  void lost(const Error& error);

  EventLoop& loop_;
  PedalSettings settings_;
  Open open_;
  Listener listener_;
  std::unique_ptr<Pedal> pedal_;
  std::optional<PedalDebouncer> debouncer_;
  EventLoop::Watch watch_;
  EventLoop::Timer settle_timer_;
  EventLoop::Timer reopen_timer_;
  BackOff back_off_;
  std::optional<Error> trouble_;
};

}  // namespace instep
