#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace instep {

/// The depth images that a sensor repeats, straight from their file.
class FrameStore {
 public:
  FrameStore(const std::filesystem::path& file, std::size_t pixels);
  ~FrameStore();
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;

  bool is_empty() const { return count_ == 0; }
  /// Image `number` of the endless repetition; of `pixels` values.
  const std::uint16_t* image(std::uint64_t number) const {
    return values_ + (number % count_) * pixels_;
  }

 private:
  const std::uint16_t* values_ = nullptr;
  std::size_t bytes_ = 0;
  std::size_t pixels_ = 0;
  std::size_t count_ = 0;
};

}  // namespace instep
