#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/result.h"

struct sd_event;
struct sd_event_source;

namespace instep {

/// One thread's loop over descriptors, timers, signals and what other threads post. A thin coat
/// over sd-event: it already joins epoll, timerfd and signalfd, and libsystemd is linked for
/// readiness and the watchdog anyway.
///
/// Callbacks run on the thread of run() and must not block. Only post() may be called from other
/// threads.
class EventLoop {
 public:
  /// Fails with kIo if the system refuses (out of descriptors).
  static Result<std::unique_ptr<EventLoop>> create();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /// Runs until leave(). Fails with kIo if waiting itself fails.
  Result<void> run();
  void leave();

  /// Runs `task` on the loop, soon and in the order of posting. Any thread; ignored once the loop
  /// is gone.
  using Post = std::function<void(std::function<void()>)>;
  Post poster() const;

  /// Watches a descriptor while it lives. `events` are those of epoll.
  class Watch {
   public:
    Watch() = default;
    void set_events(std::uint32_t events);

   private:
    friend class EventLoop;
    struct State;
    std::shared_ptr<State> state_;
  };
  /// Fails with kIo if the system refuses (a file that cannot be waited for, too many watches).
  Result<Watch> watch(int descriptor, std::uint32_t events,
                      std::function<void(std::uint32_t)> on_ready);

  /// A timer that rings once each time it is set.
  class Timer {
   public:
    Timer() = default;
    void set(std::chrono::nanoseconds from_now);
    /// On CLOCK_MONOTONIC, the clock of pedal edges.
    void set_at(std::chrono::nanoseconds monotonic_time);
    void clear();

   private:
    friend class EventLoop;
    struct State;
    std::shared_ptr<State> state_;
  };
  /// All timers share what create() has taken from the system; like any other object, one more can
  /// only want for memory, and throws std::bad_alloc then.
  Timer timer(std::function<void()> on_time);

  /// The signal must be blocked in every thread: block it before the first one starts.
  Result<void> on_signal(int signal, std::function<void()> on_signal);

  static std::chrono::nanoseconds monotonic_now();

 private:
  struct Mailbox;
  struct SignalHandler;
  EventLoop() = default;
  Result<void> open();
  Result<Timer> make_timer(std::function<void()> on_time);

  sd_event* event_ = nullptr;
  std::shared_ptr<Mailbox> mailbox_;
  Watch mail_watch_;
  Timer first_timer_;  ///< holds the descriptor that all share
  std::vector<std::unique_ptr<SignalHandler>> signal_handlers_;
};

}  // namespace instep
