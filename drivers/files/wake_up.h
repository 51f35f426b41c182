#pragma once

#include <poll.h>
#include <sys/eventfd.h>

#include <cstdint>

#include "drivers/files/descriptor.h"

namespace instep {

/// A descriptor that can be polled and that any thread or process can make readable.
class WakeUp {
 public:
  WakeUp() : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  /// One that was inherited.
  explicit WakeUp(int descriptor) : event_(descriptor) {}

  int descriptor() const { return event_.number(); }
  bool is_open() const { return event_.is_open(); }

  bool is_set() const {
    pollfd looked_at{event_.number(), POLLIN, 0};
    return ::poll(&looked_at, 1, 0) > 0;
  }
  void set() const {
    const std::uint64_t one = 1;
    // It fails only where it is set 2^64 times already.
    [[maybe_unused]] const auto written = ::write(event_.number(), &one, sizeof one);
  }
  void clear() const {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto read = ::read(event_.number(), &count, sizeof count);
  }

 private:
  Descriptor event_;
};

}  // namespace instep
