#pragma once

#include <algorithm>
#include <chrono>

namespace instep {

/// Waiting times between attempts: they double from the first to the longest. Short enough at its
/// longest that a camera that was plugged in again serves within three seconds.
class BackOff {
 public:
  static constexpr std::chrono::milliseconds kFirst{250};
  static constexpr std::chrono::milliseconds kLongest{2000};

  std::chrono::milliseconds next() {
    const auto wait = wait_;
    wait_ = std::min(2 * wait_, kLongest);
    return wait;
  }
  void reset() { wait_ = kFirst; }

 private:
  std::chrono::milliseconds wait_ = kFirst;
};

}  // namespace instep
