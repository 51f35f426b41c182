#pragma once

#include <algorithm>
#include <chrono>

namespace instep {

/// Waiting times between attempts: they double from the first to the longest. Where nothing else is
/// said, that one is short enough for a camera that was plugged in again to serve within three
/// seconds.
class BackOff {
 public:
  static constexpr std::chrono::milliseconds kFirst{250};
  static constexpr std::chrono::milliseconds kLongest{2000};

  explicit BackOff(std::chrono::milliseconds first = kFirst,
                   std::chrono::milliseconds longest = kLongest)
      : first_(first), longest_(longest) {}

  std::chrono::milliseconds next() {
    const auto wait = wait_;
    wait_ = std::min(2 * wait_, longest_);
    return wait;
  }
  void reset() { wait_ = first_; }

 private:
  std::chrono::milliseconds first_;
  std::chrono::milliseconds longest_;
  std::chrono::milliseconds wait_ = first_;
};

}  // namespace instep
