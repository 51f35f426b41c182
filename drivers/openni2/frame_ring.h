#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/fusion/frames/depth_frame.h"
#include "core/result.h"
#include "drivers/files/descriptor.h"

namespace instep {

/// What goes with the pixels of a frame in shared memory.
struct RingRecord {
  std::uint64_t sequence = 0;
  std::int64_t device_time_us = 0;
  std::int64_t host_time_ns = 0;  ///< of the steady clock, which is one for all processes
  std::int32_t width = 0;
  std::int32_t height = 0;
  FrameStatus status = FrameStatus::kGood;
  std::uint32_t pixels = 0;  ///< that follow; width * height unless something is wrong
};

/// A record and its pixels, taken out.
struct RingFrame {
  RingRecord record;
  std::vector<std::uint16_t> raw;
};

/// Frames on their way from one process to another: eight places in shared memory. The writer never
/// waits: it takes an empty place, else the one of the oldest frame. The reader owns a place while
/// it copies it out, so that no frame is ever half old and half new.
///
/// One thread writes and one reads. What is in the memory is checked on reading: a writer that runs
/// wild can send wrong frames, but not harm the reader. The memory keeps its size (it is sealed),
/// so that a reader never reads beyond its end.
class FrameRing {
 public:
  static constexpr std::size_t kPlaces = 8;
  static constexpr std::size_t kMostPixels = 1280 * 1024;

  /// New memory. Untouched pages of it cost nothing. Fails with kIo.
  static Result<FrameRing> create();
  /// That of another process, by a descriptor of it, which stays the caller's. Fails with
  /// kCorruptData if it is something else.
  static Result<FrameRing> attach(int descriptor);

  FrameRing(FrameRing&& other) noexcept;
  FrameRing& operator=(FrameRing&&) = delete;
  ~FrameRing();

  /// Of a ring that was created; to be inherited by the other process.
  int descriptor() const { return file_.number(); }

  /// Puts a frame in. `rows` holds record.pixels values, row by row, each row of record.width
  /// values `stride` values after the last. False if it has more than kMostPixels.
  bool put(const RingRecord& record, const std::uint16_t* rows, std::size_t stride);

  /// The oldest frame, if there is one.
  std::optional<RingFrame> take();
  void clear();

  /// The writer's sign of life, and when it was last given.
  void beat();
  std::chrono::steady_clock::time_point last_beat() const;

 private:
  struct Memory;
  FrameRing(Descriptor file, Memory* memory) : file_(std::move(file)), memory_(memory) {}

  std::uint16_t* pixels_of(std::size_t place) const;

  Descriptor file_;  ///< the creator's
  Memory* memory_ = nullptr;
};

}  // namespace instep
