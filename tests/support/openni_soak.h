#pragma once

#include <chrono>
#include <cstdint>

namespace instep::test {

/// What this process holds, by /proc/self.
struct Holdings {
  std::size_t threads = 0;
  std::size_t descriptors = 0;
  std::int64_t resident_kb = 0;
};

struct ReplugFigures {
  Holdings before;  ///< after some cycles that warm it up
  Holdings after;
  std::size_t children = 0;                      ///< at the end, with the sensor open
  std::chrono::milliseconds median_recovery{0};  ///< from the plugging in to the first frame
  std::chrono::milliseconds slowest_recovery{0};
};

/// Unplugs a streaming OpenNI2 sensor and plugs it in elsewhere, over and over. Throws if it does
/// not come back.
ReplugFigures replug(int cycles);

struct SteadyFigures {
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;       ///< by their sequence numbers
  double daemon_cores = 0.0;    ///< processor time of this process for each second
  double children_cores = 0.0;  ///< of instep-openni, the simulated sensors' included
};

/// Reads so many sensors of 640x480 pixels at once, as fast as they send.
SteadyFigures capture_steadily(int sensors, std::chrono::seconds time);

}  // namespace instep::test
