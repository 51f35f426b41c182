#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace instep {

/// What goes wrong in a simulated station, and when. A script has one fault a line; empty lines and
/// what follows a # are skipped. NAME is a camera's name or `all`; N, A and B count a camera's
/// frames from 1, over its whole life; D is a number and `ms` or `s`.
///
///     camera NAME: stall after N frames for D         no frame comes for D
///     camera NAME: stall after N frames               no frame comes any more
///     camera NAME: vanish after N frames, return after D
///     camera NAME: vanish after N frames              gone for good
///     camera NAME: corrupt frames A-B                 rubbish, and the frame says so
///     camera NAME: shorten frames A-B                 rows are missing, and the frame does not say
///     camera NAME: zero frames A-B                    no pixel has data
///     camera NAME: never starts                       start() fails
///     camera NAME: never streams                      starts, but no frame comes
///     pedal: bounce N edges in D                      each press and release chatters
///     pedal: stuck                                    pressed from the start, for ever
///     pedal: vanish after N edges, return after D
///     pedal: vanish after N edges                     gone for good
///
/// `frame 4` serves for `frames 4-4`.

using FaultTime = std::chrono::microseconds;

/// Something that begins when `after` frames (or edges) have come; no duration = for ever.
struct Interruption {
  std::uint64_t after = 0;
  std::optional<FaultTime> duration;
};

struct FrameRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  bool holds(std::uint64_t frame) const { return frame >= first && frame <= last; }
};

struct CameraFaults {
  std::vector<Interruption> stalls;
  std::vector<Interruption> absences;
  std::vector<FrameRange> corrupt;
  std::vector<FrameRange> shortened;
  std::vector<FrameRange> zero;
  bool never_starts = false;
  bool never_streams = false;
};

struct PedalFaults {
  std::uint64_t bounce_edges = 0;  ///< extra edges before the contact settles
  FaultTime bounce_time{0};
  bool stuck = false;
  std::optional<Interruption> absence;
};

struct FaultScript {
  std::map<std::string, CameraFaults> cameras;  ///< by name, `all` as written
  PedalFaults pedal;

  /// The faults of one camera, those of `all` included.
  CameraFaults of_camera(const std::string& name) const;
};

/// Fails with kInvalidInput and the number of the first line that cannot be understood.
Result<FaultScript> parse_fault_script(std::string_view text);

/// Fails with kInvalidInput if the script names a camera that is not among `cameras`.
Result<void> check_fault_cameras(const FaultScript& script,
                                 const std::vector<std::string>& cameras);

}  // namespace instep
