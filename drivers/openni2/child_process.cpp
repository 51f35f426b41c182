#include "drivers/openni2/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "drivers/files/descriptor.h"

namespace instep {
namespace {

constexpr int kFirstInherited = 3;
constexpr std::chrono::milliseconds kReapingLimit{500};

std::vector<std::string> environment_of(const ChildProgram& program) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const bool replaced =
        std::any_of(program.environment.begin(), program.environment.end(),
                    [&](const auto& other) { return text.rfind(other.first + "=", 0) == 0; });
    if (!replaced) variables.push_back(text);
  }
  for (const auto& [name, value] : program.environment) variables.push_back(name + "=" + value);
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The program begins with no signal blocked or ignored, whatever this thread does.
int set_plain_signals(posix_spawnattr_t& attributes) {
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  return ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
}

Error start_error(int number, const ChildProgram& program) {
  const std::string what =
      fmt::format("{} cannot be started ({})", program.file.string(), std::strerror(number));
  switch (number) {
    case ENOENT:
      return fail(ErrorCode::kNotFound, what, "install it beside instepd").value();
    case EACCES:
      return fail(ErrorCode::kPermissionDenied, what, "let the user of the station run it").value();
    default:
      return fail(ErrorCode::kIo, Remedy::kRetry, what, "free some memory or processes").value();
  }
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const ChildProgram& program) {
  // Copies above all the numbers that they get, so that none is overwritten before its turn.
  constexpr int kAbove = 64;
  std::vector<std::unique_ptr<Descriptor>> copies;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (program.output) {
    ::posix_spawn_file_actions_adddup2(&actions, *program.output, STDOUT_FILENO);
  } else {
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  int next = kFirstInherited;
  for (const int descriptor : program.descriptors) {
    copies.push_back(std::make_unique<Descriptor>(::fcntl(descriptor, F_DUPFD_CLOEXEC, kAbove)));
    ::posix_spawn_file_actions_adddup2(&actions, copies.back()->number(), next++);
  }
  ::posix_spawn_file_actions_addclosefrom_np(&actions, next);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  set_plain_signals(attributes);

  std::vector<std::string> words = program.arguments;
  words.insert(words.begin(), program.file.filename().string());
  std::vector<std::string> variables = environment_of(program);
  pid_t id = -1;
  const int failure = ::posix_spawn(&id, program.file.c_str(), &actions, &attributes,
                                    pointers_to(words).data(), pointers_to(variables).data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return tl::make_unexpected(start_error(failure, program));
  const int descriptor = static_cast<int>(::syscall(SYS_pidfd_open, id, 0));
  ChildProcess child(id, descriptor);
  if (descriptor < 0) return tl::make_unexpected(start_error(errno, program));
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ChildProcess::~ChildProcess() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    wait(kReapingLimit);
  }
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<std::string> ChildProcess::wait(std::chrono::milliseconds limit) {
  if (id_ <= 0) return "has ended";
  pollfd waited{descriptor_, POLLIN, 0};
  while (::poll(&waited, 1, static_cast<int>(limit.count())) < 0 && errno == EINTR) continue;
  // Readable, it has ended, and waiting for it does not block but for the kernel's last touch.
  int status = 0;
  if (::waitpid(id_, &status, waited.revents != 0 ? 0 : WNOHANG) != id_) return std::nullopt;
  id_ = -1;
  return WIFSIGNALED(status) ? fmt::format("was ended by signal {} ({})", WTERMSIG(status),
                                           ::strsignal(WTERMSIG(status)))
                             : fmt::format("ended with code {}", WEXITSTATUS(status));
}

}  // namespace instep
