#include "daemon/service/clock_watch.h"

#include <ctime>

namespace instep {
namespace {

/// A machine without a clock of its own may wake with the time at which it went to sleep, and has
/// it set a moment later.
constexpr std::chrono::hours kSetByMuch{7 * 24};

}  // namespace

bool ClockWatch::was_set(const Reading& now) {
  const auto set_by = (now.clock - first_.clock) - (now.since_boot - first_.since_boot);
  was_set_ = was_set_ || std::chrono::abs(set_by) > kSetByMuch;
  return was_set_;
}

ClockWatch::Reading ClockWatch::read() {
  timespec since_boot{};
  ::clock_gettime(CLOCK_BOOTTIME, &since_boot);
  return {std::chrono::system_clock::now(),
          std::chrono::seconds(since_boot.tv_sec) + std::chrono::nanoseconds(since_boot.tv_nsec)};
}

}  // namespace instep
