#pragma once

#include <cerrno>
#include <cstdint>

#include "drivers/v4l2/video_system.h"

namespace instep {

/// Most entries of a list that a driver is asked for: one that never ends it must not keep us.
inline constexpr std::uint32_t kMostListed = 256;

/// An ioctl that a signal does not cut short. -1 and errno if it fails.
inline int video_call(VideoSystem& system, int descriptor, unsigned long request, void* argument) {
  int outcome = 0;
  do {
    outcome = system.control(descriptor, request, argument);
  } while (outcome == -1 && errno == EINTR);
  return outcome;
}

}  // namespace instep
