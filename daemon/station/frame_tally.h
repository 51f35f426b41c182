#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"

namespace instep {

/// What is wrong with a frame, the first that applies.
enum class FrameFault {
  kNone,
  kErrorFlagged,  ///< its driver says so, or its content contradicts its format
  kShort,         ///< pixels are missing, whether its driver says so or not
  kStale,         ///< of before the stream began, or seen already
  kEmpty,         ///< hardly a pixel has depth
};

/// Why a camera is given up that has sent faulty frames only; `last`: what was wrong with the last.
Error bad_frames_only(FrameFault last);

/// The frames of a camera since the daemon began.
struct FrameCounts {
  std::uint64_t good = 0;  ///< those that only warmed the camera up included
  std::uint64_t error_flagged = 0;
  std::uint64_t short_of_pixels = 0;
  std::uint64_t stale = 0;
  std::uint64_t empty = 0;
  std::uint64_t lost = 0;  ///< never came, as gaps in the sequence show

  std::uint64_t faulty() const { return error_flagged + short_of_pixels + stale + empty; }
};

/// Judges the frames of one camera, and counts them. Safe from any thread.
class FrameTally {
 public:
  /// A frame with depth in a smaller part of its pixels is empty: nothing there, or nearly nothing,
  /// could be measured. Two feet alone, all else cut away, fill 9 to 14 % of a depth camera's
  /// image.
  static constexpr double kLeastValidShare = 0.01;

  /// The next frame follows none: between two streams nothing is lost.
  void begin_stream();
  /// Only a frame without a fault may be used.
  FrameFault count(const DepthFrame& frame);

  FrameCounts counts() const;

 private:
  mutable std::mutex mutex_;
  FrameCounts counts_;
  std::optional<std::uint64_t> last_sequence_;
};

}  // namespace instep
