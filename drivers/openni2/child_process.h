#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "drivers/files/descriptor.h"

namespace instep {

/// A program to run beside this one.
struct ChildProgram {
  std::filesystem::path file;
  std::vector<std::string> arguments;
  /// Variables that differ from those of this process.
  std::vector<std::pair<std::string, std::string>> environment;
  /// It has these as 3, 4, ..., its stdin and stdout on /dev/null, the stderr of this process, and
  /// no other descriptor.
  std::vector<int> descriptors;
  /// One that takes the place of /dev/null as its stdout.
  std::optional<int> output;
};

/// A process of our own that does not outlive this object.
class ChildProcess {
 public:
  /// Fails with kNotFound or kPermissionDenied if there is no running the program, with kIo if
  /// there is no process to be had.
  static Result<ChildProcess> start(const ChildProgram& program);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  /// Kills and reaps it. Waits for that up to 0.5 s, for a process in an uninterruptible wait of
  /// the kernel (a USB stack that hangs) cannot be ended; it is then left to itself.
  ~ChildProcess();

  pid_t id() const { return id_; }

  /// Waits up to `limit` for its end and says how it ended, such as "ended by signal 11"; nothing
  /// if it runs on.
  std::optional<std::string> wait(std::chrono::milliseconds limit);

 private:
  ChildProcess(pid_t id, Descriptor end) : id_(id), end_(std::move(end)) {}

  pid_t id_ = -1;   ///< -1 once it was reaped
  Descriptor end_;  ///< becomes readable then
};

}  // namespace instep
