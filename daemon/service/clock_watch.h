#pragma once

#include <chrono>

namespace instep {

/// Tells whether the machine's clock was set by much while the daemon runs: what hangs on the age
/// of results had better wait then, since nothing tells whether it was wrong before or is so now.
class ClockWatch {
 public:
  struct Reading {
    std::chrono::system_clock::time_point clock;
    std::chrono::nanoseconds since_boot;  ///< time asleep counts
  };

  explicit ClockWatch(const Reading& first) : first_(first) {}

  /// By more than a week since the first reading. Once set it stays so: a clock set back again may
  /// be set once more.
  bool was_set(const Reading& now);

  /// Of this machine.
  static Reading read();

 private:
  Reading first_;
  bool was_set_ = false;
};

}  // namespace instep
