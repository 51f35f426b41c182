#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/usb_watch.h"

namespace instep {

/// Makes one piece of news of all that a plug tells while it goes in or out: events come twice, a
/// departure without an arrival, and a loose plug gives hundreds. A device is reported when nothing
/// was heard of it for a while. No clock of its own; not thread-safe.
class UsbPresence {
 public:
  using Time = std::chrono::nanoseconds;  ///< of CLOCK_MONOTONIC
  static constexpr std::chrono::milliseconds kSettle{200};

  void note(const UsbChange& change, Time now);

  /// What has settled by now, as it is in the end: a device that was replugged has arrived, one
  /// that came and went, and may have been opened meanwhile, has left.
  std::vector<UsbChange> settled(Time now);

  /// When settled() has news next; nothing = nothing settles.
  std::optional<Time> next_deadline() const;

 private:
  struct Place {
    UsbChange last;
    bool was_there = false;  ///< as reported
    bool arrived = false;    ///< since then
    Time settles{0};
    bool settling = false;
  };
  std::map<std::string, Place> places_;  ///< by bus path
};

}  // namespace instep
