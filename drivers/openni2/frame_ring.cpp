#include "drivers/openni2/frame_ring.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <new>
#include <utility>

namespace instep {
namespace {

/// Who has a place. Only the writer leaves kEmpty and only the reader enters it.
enum PlaceState : std::uint32_t { kEmpty, kWriting, kFull, kReading };

constexpr std::size_t kPage = 4096;
constexpr std::size_t kBytesOfPlace = FrameRing::kMostPixels * sizeof(std::uint16_t);
constexpr std::uint64_t kMagic = 0x31474e4952494e4fU;

Error no_memory() {
  return {ErrorCode::kIo, Remedy::kRetry, "there is no shared memory for the frames of a camera",
          "free some memory"};
}

}  // namespace

struct FrameRing::Memory {
  struct Place {
    std::atomic<std::uint32_t> state = kEmpty;
    std::atomic<std::uint64_t> order = 0;  ///< of arrival; may be read while others write
    RingRecord record;
  };
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

  std::uint64_t magic = kMagic;
  std::atomic<std::int64_t> beat_ns = 0;
  std::uint64_t arrived = 0;  ///< of the writer alone
  std::array<Place, kPlaces> places;

  struct Full {
    std::size_t place = 0;
    std::uint64_t order = 0;
  };
  /// The place that was filled first, as it is at a glance: the other side goes on meanwhile.
  std::optional<Full> oldest() const {
    std::optional<Full> found;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      if (places[i].state != kFull) continue;
      const Full full{i, places[i].order};
      if (!found || full.order < found->order) found = full;
    }
    return found;
  }

  bool change(std::size_t place, PlaceState from, PlaceState to) {
    std::uint32_t expected = from;
    return places[place].state.compare_exchange_strong(expected, to);
  }

  /// A place for the writer. The reader holds one of them at most, so that there is always another.
  std::size_t place_to_write() {
    while (true) {
      for (std::size_t i = 0; i < kPlaces; ++i) {
        if (change(i, kEmpty, kWriting)) return i;
      }
      const auto full = oldest();
      if (full && change(full->place, kFull, kWriting)) return full->place;
    }
  }
};

namespace {

constexpr std::size_t kPixelsFrom = kPage;
constexpr std::size_t kBytes = kPixelsFrom + FrameRing::kPlaces * kBytesOfPlace;

void* map(int descriptor) {
  void* mapped = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  return mapped == MAP_FAILED ? nullptr : mapped;
}

}  // namespace

Result<FrameRing> FrameRing::create() {
  static_assert(sizeof(Memory) <= kPixelsFrom);
  Descriptor file(::memfd_create("instep-frames", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!file.is_open() || ::ftruncate(file.number(), static_cast<off_t>(kBytes)) != 0 ||
      ::fcntl(file.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) {
    return tl::make_unexpected(no_memory());
  }
  void* mapped = map(file.number());
  if (mapped == nullptr) return tl::make_unexpected(no_memory());
  return FrameRing(std::move(file), new (mapped) Memory);
}

Result<FrameRing> FrameRing::attach(int descriptor) {
  struct stat status {};
  const bool sized =
      ::fstat(descriptor, &status) == 0 && static_cast<std::size_t>(status.st_size) == kBytes;
  void* mapped = sized ? map(descriptor) : nullptr;
  if (mapped == nullptr || static_cast<Memory*>(mapped)->magic != kMagic) {
    if (mapped != nullptr) ::munmap(mapped, kBytes);
    return fail(ErrorCode::kCorruptData, "the shared memory is not that of a frame ring",
                "install the programs of one version together");
  }
  return FrameRing(Descriptor(), static_cast<Memory*>(mapped));
}

FrameRing::FrameRing(FrameRing&& other) noexcept
    : file_(std::move(other.file_)), memory_(std::exchange(other.memory_, nullptr)) {}

FrameRing::~FrameRing() {
  if (memory_ != nullptr) ::munmap(memory_, kBytes);
}

std::uint16_t* FrameRing::pixels_of(std::size_t place) const {
  auto* bytes = reinterpret_cast<std::byte*>(memory_) + kPixelsFrom + place * kBytesOfPlace;
  return reinterpret_cast<std::uint16_t*>(bytes);
}

bool FrameRing::put(const RingRecord& record, const std::uint16_t* rows, std::size_t stride) {
  const std::size_t pixels = record.pixels;
  if (pixels > kMostPixels || (pixels > 0 && record.width <= 0)) return false;
  const std::size_t at = memory_->place_to_write();
  Memory::Place& place = memory_->places[at];
  place.record = record;
  place.order = ++memory_->arrived;
  const auto width = static_cast<std::size_t>(std::max(record.width, 1));
  std::uint16_t* to = pixels_of(at);
  for (std::size_t done = 0; done < pixels; done += width, rows += stride) {
    std::copy_n(rows, std::min(width, pixels - done), to + done);
  }
  place.state = kFull;
  return true;
}

std::optional<RingFrame> FrameRing::take() {
  for (std::size_t tries = 0; tries < 2 * kPlaces; ++tries) {
    const auto full = memory_->oldest();
    if (!full) return std::nullopt;
    if (!memory_->change(full->place, kFull, kReading)) continue;
    Memory::Place& place = memory_->places[full->place];
    // While this thread looked, the writer may have gone round. All that came before the frame in
    // hand is there by now, so that a second look is exact.
    const auto earlier = memory_->oldest();
    if (earlier && earlier->order < place.order) {
      place.state = kFull;
      continue;
    }
    RingFrame frame;
    frame.record = place.record;
    const std::size_t pixels = std::min<std::size_t>(frame.record.pixels, kMostPixels);
    const std::uint16_t* from = pixels_of(full->place);
    frame.raw.assign(from, from + pixels);
    place.state = kEmpty;
    return frame;
  }
  return std::nullopt;
}

void FrameRing::clear() {
  for (std::size_t i = 0; i < kPlaces; ++i) memory_->change(i, kFull, kEmpty);
}

void FrameRing::beat() {
  memory_->beat_ns =
      std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::chrono::steady_clock::time_point FrameRing::last_beat() const {
  const std::chrono::steady_clock::time_point told(std::chrono::nanoseconds(memory_->beat_ns));
  return std::min(told, std::chrono::steady_clock::now());
}

}  // namespace instep
