#pragma once

#include "core/result.h"

namespace instep {

/// A line that the station switches: a lamp, a projector. One thread owns it. It is off when it is
/// opened, and its destructor puts it off again.
class OutputLine {
 public:
  virtual ~OutputLine() = default;

  /// Takes as long as the device's bus takes: microseconds on the board, perhaps for ever behind a
  /// cable. To say the same again is worth it: fails with kDeviceGone once the device has left, for
  /// good; another line can be opened when it is back.
  virtual Result<void> set(bool on) = 0;
};

}  // namespace instep
