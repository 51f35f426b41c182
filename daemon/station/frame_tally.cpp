#include "daemon/station/frame_tally.h"

#include <algorithm>

namespace instep {
namespace {

bool is_empty(const DepthFrame& frame) {
  const auto valid = std::count_if(frame.raw.begin(), frame.raw.end(),
                                   [](std::uint16_t depth) { return depth != 0; });
  return static_cast<double>(valid) <
         FrameTally::kLeastValidShare * static_cast<double>(frame.raw.size());
}

FrameFault fault_of(const DepthFrame& frame) {
  const auto pixels =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  switch (frame.status) {
    case FrameStatus::kCorrupt:
      return FrameFault::kErrorFlagged;
    case FrameStatus::kIncomplete:
      return FrameFault::kShort;
    case FrameStatus::kStale:
      return FrameFault::kStale;
    case FrameStatus::kGood:
      break;
  }
  if (frame.raw.size() < pixels) return FrameFault::kShort;
  return is_empty(frame) ? FrameFault::kEmpty : FrameFault::kNone;
}

}  // namespace

Error bad_frames_only(FrameFault last) {
  if (last == FrameFault::kEmpty) {
    return {ErrorCode::kCorruptData, Remedy::kReset, "it sees nothing: its frames are empty",
            "see whether something covers it or glares at it"};
  }
  return {ErrorCode::kCorruptData, Remedy::kReset, "it sends damaged frames only",
          "check its cable, and that it has a USB controller of its own"};
}

void FrameTally::begin_stream() {
  const std::lock_guard lock(mutex_);
  last_sequence_.reset();
}

FrameFault FrameTally::count(const DepthFrame& frame) {
  const FrameFault fault = fault_of(frame);
  const std::lock_guard lock(mutex_);
  if (last_sequence_ && frame.sequence > *last_sequence_ + 1) {
    counts_.lost += frame.sequence - *last_sequence_ - 1;
  }
  last_sequence_ = std::max(frame.sequence, last_sequence_.value_or(0));
  switch (fault) {
    case FrameFault::kNone:
      ++counts_.good;
      break;
    case FrameFault::kErrorFlagged:
      ++counts_.error_flagged;
      break;
    case FrameFault::kShort:
      ++counts_.short_of_pixels;
      break;
    case FrameFault::kStale:
      ++counts_.stale;
      break;
    case FrameFault::kEmpty:
      ++counts_.empty;
      break;
  }
  return fault;
}

FrameCounts FrameTally::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace instep
