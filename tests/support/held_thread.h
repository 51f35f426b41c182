#pragma once

#include <signal.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include "drivers/files/descriptor.h"

namespace instep::test {

/// Keeps a thread of this process, once it has nothing to do, from going on, as a busy machine may;
/// as long as this lives.
class HeldThread {
 public:
  /// By gettid().
  explicit HeldThread(pid_t thread) {
    while (!is_asleep(thread)) std::this_thread::yield();
    struct sigaction holding {};
    holding.sa_handler = [](int) {
      add_to(held_.number());
      take_from(let_go_.number());
      add_to(over_.number());
    };
    ::sigaction(SIGUSR2, &holding, &before_);
    ::syscall(SYS_tgkill, ::getpid(), thread, SIGUSR2);
    take_from(held_.number());
  }
  ~HeldThread() {
    add_to(let_go_.number());
    take_from(over_.number());
    ::sigaction(SIGUSR2, &before_, nullptr);
  }
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;

 private:
  /// As the kernel shows it: "number (name) state ...".
  static bool is_asleep(pid_t thread) {
    std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
    std::string line;
    std::getline(file, line);
    const auto end_of_name = line.rfind(')');
    return end_of_name != std::string::npos && line.substr(end_of_name, 3) == ") S";
  }
  static void add_to(int counter) {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(counter, &one, sizeof one);
  }
  static void take_from(int counter) {
    std::uint64_t count = 0;
    while (::read(counter, &count, sizeof count) < 0) {
    }
  }

  static inline const Descriptor held_{::eventfd(0, EFD_CLOEXEC)};
  static inline const Descriptor let_go_{::eventfd(0, EFD_CLOEXEC)};
  static inline const Descriptor over_{::eventfd(0, EFD_CLOEXEC)};
  struct sigaction before_ {};
};

}  // namespace instep::test
