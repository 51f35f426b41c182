#pragma once

#include <poll.h>
#include <sys/types.h>

#include <cstddef>

namespace instep {

/// The system calls of a V4L2 camera, gathered so that tests can put a model of the kernel in their
/// place. Each does what its namesake does (`control` is ioctl): -1, or MAP_FAILED, and errno when
/// it fails. Safe from any thread, as the calls themselves are.
class VideoSystem {
 public:
  virtual ~VideoSystem() = default;

  virtual int open(const char* path, int flags) = 0;
  virtual int close(int descriptor) = 0;
  virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  virtual void* map(std::size_t length, int descriptor, off_t offset) = 0;
  virtual int unmap(void* memory, std::size_t length) = 0;
  virtual int poll(pollfd* waiting, nfds_t count, int timeout_ms) = 0;
};

/// The running kernel.
VideoSystem& linux_video_system();

}  // namespace instep
