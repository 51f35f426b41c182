#include "drivers/v4l2/frame_order.h"

#include <algorithm>

namespace instep {
namespace {

/// Steps of more than half the circle are steps back.
constexpr std::uint32_t kLargestStep = 1U << 31U;

}  // namespace

FrameOrder::Place FrameOrder::place(std::uint32_t sequence, std::optional<Time> stamp, Time now) {
  if (stamp && stamp->count() == 0) stamp.reset();
  const std::uint32_t step = last_sequence_ ? sequence - *last_sequence_ : 0;
  const bool first = !last_sequence_;
  const bool forward = step > 0 && step < kLargestStep;
  const bool same_buffer = !first && step == 0 && stamp && stamp == last_stamp_;
  if (stamp && last_stamp_ && *stamp <= *last_stamp_ && !same_buffer) clock_is_good_ = false;
  if (stamp && *stamp > now) clock_is_good_ = false;

  Place place;
  place.stale = same_buffer || (stamp && clock_is_good_ && *stamp < begin_);
  if (first) {
    count_ = sequence;
  } else if (!same_buffer) {
    count_ += forward ? step : 1;
  }
  place.sequence = count_;
  place.time = stamp && clock_is_good_ ? *stamp : now;
  place.time = std::max(place.time, last_time_ + Time(1));
  if (!place.stale) last_time_ = place.time;
  last_sequence_ = sequence;
  last_stamp_ = stamp;
  return place;
}

}  // namespace instep
