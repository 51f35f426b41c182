#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace instep {

/// Puts the buffers of one stream in order, whatever their driver stamps on them: constant, zero
/// and backward time stamps and sequence numbers are all seen in the field.
///
/// A clock that stands still or goes back is not believed for the rest of its stream; frames then
/// have the time at which they were received. Sequence numbers go on past 2^32.
class FrameOrder {
 public:
  using Time = std::chrono::microseconds;  ///< of CLOCK_MONOTONIC

  /// `begin` is when the stream was switched on.
  explicit FrameOrder(Time begin) : begin_(begin) {}

  struct Place {
    std::uint64_t sequence = 0;  ///< from the driver's; a gap means frames that were lost
    Time time{0};                ///< later than that of the frame before
    bool stale = false;          ///< from before this stream, or a buffer seen already
  };

  /// `stamp` is nothing where the buffer's flags do not say CLOCK_MONOTONIC.
  Place place(std::uint32_t sequence, std::optional<Time> stamp, Time now);

 private:
  Time begin_;
  bool clock_is_good_ = true;
  std::optional<std::uint32_t> last_sequence_;
  std::optional<Time> last_stamp_;
  std::uint64_t count_ = 0;  ///< Place::sequence of the last frame
  Time last_time_ = Time::min();
};

}  // namespace instep
