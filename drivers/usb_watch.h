#pragma once

#include <vector>

#include "drivers/usb/usb_device.h"

namespace instep {

/// A device came to the USB bus or left it.
struct UsbChange {
  UsbDevice device;  ///< one that left, as it was
  bool arrived = false;
};

/// A source of comings and goings for an event loop. Raw: a change may be told twice, and a loose
/// plug tells many; making sense of them is the daemon's work. One thread owns it and makes all
/// calls; another may wait for its descriptor.
class UsbWatch {
 public:
  virtual ~UsbWatch() = default;

  /// Readable (POLLIN) when changes() has work. Owned by the watch; stays the same.
  virtual int descriptor() const = 0;

  /// What changed since the last call, oldest first; at the first call what is plugged in already.
  /// Waits for no event, but for what is asked of each device that came: the kernel answers once
  /// the device's driver is not at it, which with a faulty one takes seconds, or for ever.
  virtual std::vector<UsbChange> changes() = 0;
};

}  // namespace instep
