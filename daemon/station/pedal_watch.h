#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "config/settings.h"
#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "daemon/station/back_off.h"
#include "daemon/station/pedal_debouncer.h"
#include "drivers/pedal.h"

namespace instep {

/// The trouble that the signals of these names stand for.
Error stuck_pedal();
Error chattering_pedal();
/// That of one that hangs.
Error silent_pedal();

/// A pedal on the event loop: lets the debouncer judge its edges, opens it again when it was lost.
/// A pedal may hang in any call, so it is touched on a thread of its own. One that does not answer
/// is a trouble; once it does, it is opened afresh, so that what came meanwhile starts no scan.
///
/// Lives on the loop's thread, where no call but end_by() waits, and longer than the loop runs.
class PedalWatch {
 public:
  /// What the owner is told.
  struct Listener {
    std::function<void(PedalSignal)> on_signal;
    std::function<void(const Error&)> on_lost;  ///< and again when the cause is another one
    /// It is open, or there is to be none: at first, and again after on_lost.
    std::function<void()> on_returned;
  };
  /// Opens the pedal, on its thread; asked again with growing pauses as long as it fails.
  using Open = std::function<Result<std::unique_ptr<Pedal>>()>;

  /// A pedal that has not done what it was asked for so long hangs.
  static constexpr std::chrono::milliseconds kPatience{5000};
  /// What its closing has at the end.
  static constexpr std::chrono::milliseconds kLastMoment{200};

  PedalWatch(EventLoop& loop, const PedalSettings& settings, Open open, Listener listener,
             std::chrono::milliseconds patience = kPatience);
  /// end_by() kLastMoment from now.
  ~PedalWatch();
  PedalWatch(const PedalWatch&) = delete;
  PedalWatch& operator=(const PedalWatch&) = delete;

  /// New times hold at once, for a press that is under way too.
  void set(const PedalSettings& settings);

  /// Has the pedal closed; the loop has ended, and no call but end_by() may follow.
  void put_off();
  /// The same, and waits for it; false if it hangs and had to be left behind. No call but the
  /// destructor may follow.
  bool end_by(std::chrono::steady_clock::time_point deadline);

 private:
  /// Of a pedal that is open.
  struct Opened {
    int descriptor = -1;
    bool pressed = false;
  };
  /// What a look at it brought.
  struct Seen {
    std::vector<PedalEdge> edges;
    std::optional<bool> pressed;
    std::chrono::nanoseconds time{0};  ///< of `pressed`
  };

  static Result<std::optional<Opened>> bring_up(std::unique_ptr<Pedal>& pedal, const Open& open);
  static Result<Seen> look_at(Pedal& pedal, bool asks_level);
  void open();
  void begin(const Opened& opened);
  void returned();
  void look(bool asks_level);
  void take(const Result<Seen>& seen);
  void pass_on();
  void fell_silent();
  void lost(const Error& error);
  void tell(const Error& error);

  EventLoop& loop_;
  PedalSettings settings_;
  Open open_;
  Listener listener_;
  std::chrono::milliseconds patience_;
  std::optional<PedalDebouncer> debouncer_;
  EventLoop::Watch watch_;
  EventLoop::Timer settle_timer_;
  EventLoop::Timer reopen_timer_;
  EventLoop::Timer patience_timer_;
  BackOff back_off_;
  std::optional<Error> trouble_;
  bool is_known_ = false;  ///< the owner was told whether it is there
  bool is_looking_ = false;
  bool is_silent_ = false;    ///< what it was asked last took longer than patience_
  bool may_be_open_ = false;  ///< nothing is to be closed where there is none
  std::shared_ptr<std::unique_ptr<Pedal>> pedal_;  ///< the thread's, to its end
  TaskThread thread_{"pedal"};
};

}  // namespace instep
