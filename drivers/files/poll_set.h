#pragma once

#include <sys/epoll.h>

#include <cstdint>

#include "drivers/files/descriptor.h"

namespace instep {

/// One descriptor for whoever can wait for no more: readable while something comes to any of those
/// that were added. They stay their owners', and are left out once they are closed.
class PollSet {
 public:
  PollSet() : set_(::epoll_create1(EPOLL_CLOEXEC)) {}

  int descriptor() const { return set_.number(); }
  bool is_open() const { return set_.is_open(); }

  /// `events` are those of epoll. False, with errno, if the system refuses.
  bool add(int descriptor, std::uint32_t events = EPOLLIN) const {
    epoll_event interest{};
    interest.events = events;
    return ::epoll_ctl(set_.number(), EPOLL_CTL_ADD, descriptor, &interest) == 0;
  }

 private:
  Descriptor set_;
};

}  // namespace instep
