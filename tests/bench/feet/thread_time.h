#pragma once

#include <ctime>

namespace instep::bench {

/// What this thread has computed so far: what runs beside it does not count.
inline double thread_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace instep::bench
