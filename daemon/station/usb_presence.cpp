#include "daemon/station/usb_presence.h"

#include <algorithm>

namespace instep {

void UsbPresence::note(const UsbChange& change, Time now) {
  Place& place = places_[change.device.address.bus_path];
  place.last = change;
  place.arrived = place.arrived || change.arrived;
  place.settles = now + kSettle;
  place.settling = true;
}

std::vector<UsbChange> UsbPresence::settled(Time now) {
  std::vector<UsbChange> news;
  for (auto place = places_.begin(); place != places_.end();) {
    Place& at = place->second;
    if (at.settling && at.settles <= now) {
      // Only of a device that was never there nothing is said.
      if (at.was_there || at.arrived) news.push_back(at.last);
      at.was_there = at.last.arrived;
      at.arrived = false;
      at.settling = false;
    }
    // What is away needs no memory.
    place = at.settling || at.was_there ? std::next(place) : places_.erase(place);
  }
  return news;
}

std::optional<UsbPresence::Time> UsbPresence::next_deadline() const {
  std::optional<Time> next;
  for (const auto& [path, place] : places_) {
    if (place.settling) next = std::min(next.value_or(place.settles), place.settles);
  }
  return next;
}

}  // namespace instep
