#pragma once

#include <algorithm>
#include <cstdint>

namespace instep {

/// Numbers the frames of a camera for its whole life from the numbers of its sensor, which tell how
/// many were lost. They grow, also where a sensor begins to count anew or runs wild.
class FrameNumbers {
 public:
  /// More than a station loses in a day; a sensor that tells of more is not to be believed.
  static constexpr std::uint64_t kMostLost = 10'000'000;

  /// The next number of the sensor, which is above 0, follows none.
  void begin_stream() { last_of_sensor_ = 0; }

  std::uint64_t next(std::uint64_t of_sensor) {
    if (last_of_sensor_ > 0 && of_sensor > last_of_sensor_) {
      next_ += std::min(of_sensor - last_of_sensor_ - 1, kMostLost);
    }
    last_of_sensor_ = of_sensor;
    return next_++;
  }

 private:
  std::uint64_t next_ = 0;
  std::uint64_t last_of_sensor_ = 0;
};

}  // namespace instep
