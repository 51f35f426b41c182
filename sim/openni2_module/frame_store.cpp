#include "sim/openni2_module/frame_store.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace instep {

FrameStore::FrameStore(const std::filesystem::path& file, std::size_t pixels) : pixels_(pixels) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0) bytes_ = static_cast<std::size_t>(status.st_size);
  void* mapped =
      bytes_ > 0 ? ::mmap(nullptr, bytes_, PROT_READ, MAP_PRIVATE, descriptor, 0) : MAP_FAILED;
  ::close(descriptor);
  if (mapped == MAP_FAILED) return;
  values_ = static_cast<const std::uint16_t*>(mapped);
  count_ = bytes_ / (pixels * sizeof(std::uint16_t));
}

FrameStore::~FrameStore() {
  if (values_ != nullptr) ::munmap(const_cast<std::uint16_t*>(values_), bytes_);
}

}  // namespace instep
