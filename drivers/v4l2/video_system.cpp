#include "drivers/v4l2/video_system.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace instep {
namespace {

class LinuxVideoSystem final : public VideoSystem {
 public:
  int open(const char* path, int flags) override { return ::open(path, flags); }
  int close(int descriptor) override { return ::close(descriptor); }
  int control(int descriptor, unsigned long request, void* argument) override {
    return ::ioctl(descriptor, request, argument);
  }
  void* map(std::size_t length, int descriptor, off_t offset) override {
    return ::mmap(nullptr, length, PROT_READ, MAP_SHARED, descriptor, offset);
  }
  int unmap(void* memory, std::size_t length) override { return ::munmap(memory, length); }
  int poll(pollfd* waiting, nfds_t count, int timeout_ms) override {
    return ::poll(waiting, count, timeout_ms);
  }
};

}  // namespace

VideoSystem& linux_video_system() {
  static LinuxVideoSystem system;
  return system;
}

}  // namespace instep
