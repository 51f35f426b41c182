#pragma once

#include <chrono>
#include <vector>

#include "core/result.h"

namespace instep {

/// The pedal's contact closed or opened. Raw: a real contact bounces, and telling presses from
/// edges is the debouncer's work (daemon).
struct PedalEdge {
  bool pressed = false;
  std::chrono::nanoseconds time{0};  ///< on the clock of the event source (CLOCK_MONOTONIC)
};

/// A foot pedal as a source of edges. One thread owns it and makes all calls; another may wait for
/// its descriptor. No call waits for a foot, but each takes as long as the device's bus takes, to
/// open and to close it too: microseconds on the board, perhaps for ever behind a cable.
class Pedal {
 public:
  virtual ~Pedal() = default;

  /// Readable (POLLIN) when edges wait or the pedal is gone. Owned by the pedal; stays the same
  /// until reopen().
  virtual int descriptor() const = 0;

  /// The edges that wait, oldest first; empty if none. Returns though more come without end: the
  /// descriptor is readable then. Fails with kDeviceGone if the pedal left.
  virtual Result<std::vector<PedalEdge>> read_edges() = 0;

  /// The contact as it is now. After a burst this settles what lost edges leave open.
  virtual Result<bool> is_pressed() = 0;

  /// Opens it again after kDeviceGone.
  virtual Result<void> reopen() = 0;
};

}  // namespace instep
