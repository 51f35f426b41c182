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
#include <system_error>

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

/// What the program finds: its descriptors, and no signal blocked or ignored, whatever this thread
/// does.
class Surroundings {
 public:
  explicit Surroundings(const ChildProgram& program) {
    note(::posix_spawn_file_actions_init(&actions_));
    note(::posix_spawnattr_init(&attributes_));
    open_null(STDIN_FILENO, O_RDONLY);
    if (program.output) {
      note(::posix_spawn_file_actions_adddup2(&actions_, *program.output, STDOUT_FILENO));
    } else {
      open_null(STDOUT_FILENO, O_WRONLY);
    }
    int next = kFirstInherited;
    for (const int descriptor : program.descriptors) inherit(descriptor, next++);
    note(::posix_spawn_file_actions_addclosefrom_np(&actions_, next));
    set_plain_signals();
  }
  ~Surroundings() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }
  /// The first errno value that preparing them met; 0 if they are as asked.
  int failure() const { return failure_; }

 private:
  void note(int failure) {
    if (failure_ == 0) failure_ = failure;
  }

  void open_null(int as, int how) {
    note(::posix_spawn_file_actions_addopen(&actions_, as, "/dev/null", how, 0));
  }

  /// By way of a copy above all the numbers that are given, so that none is overwritten before its
  /// turn.
  void inherit(int descriptor, int as) {
    constexpr int kAbove = 64;
    Descriptor copy(::fcntl(descriptor, F_DUPFD_CLOEXEC, kAbove));
    // Invalid is a number above the limit on open files.
    if (!copy.is_open()) return note(errno == EINVAL ? EMFILE : errno);
    note(::posix_spawn_file_actions_adddup2(&actions_, copy.number(), as));
    copies_.push_back(std::move(copy));
  }

  void set_plain_signals() {
    sigset_t none;
    sigset_t all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    note(::posix_spawnattr_setsigmask(&attributes_, &none));
    note(::posix_spawnattr_setsigdefault(&attributes_, &all));
    note(::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  }

  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
  std::vector<Descriptor> copies_;
  int failure_ = 0;
};

/// Within the limit, however many signals come.
bool is_readable(int descriptor, std::chrono::milliseconds limit) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + limit;
  pollfd waited{descriptor, POLLIN, 0};
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    const int ready = ::poll(&waited, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

Error start_error(int number, const ChildProgram& program) {
  const std::string what = fmt::format("{} cannot be started ({})", program.file.string(),
                                       std::generic_category().message(number));
  switch (number) {
    case ENOENT:
      return fail(ErrorCode::kNotFound, what, "install it beside instepd").value();
    case EACCES:
      return fail(ErrorCode::kPermissionDenied, what, "let the user of the station run it").value();
    case EMFILE:
    case ENFILE:
      return fail(ErrorCode::kIo, Remedy::kRetry, what, "raise the limit on open files").value();
    default:
      return fail(ErrorCode::kIo, Remedy::kRetry, what, "free some memory or processes").value();
  }
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const ChildProgram& program) {
  const Surroundings surroundings(program);
  if (surroundings.failure() != 0) {
    return tl::make_unexpected(start_error(surroundings.failure(), program));
  }
  std::vector<std::string> words = program.arguments;
  words.insert(words.begin(), program.file.filename().string());
  std::vector<std::string> variables = environment_of(program);
  pid_t id = -1;
  const int failure =
      ::posix_spawn(&id, program.file.c_str(), surroundings.actions(), surroundings.attributes(),
                    pointers_to(words).data(), pointers_to(variables).data());
  if (failure != 0) return tl::make_unexpected(start_error(failure, program));
  Descriptor end(static_cast<int>(::syscall(SYS_pidfd_open, id, 0)));
  const int why_not = errno;
  const bool is_watched = end.is_open();
  ChildProcess child(id, std::move(end));
  if (!is_watched) return tl::make_unexpected(start_error(why_not, program));
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), end_(std::move(other.end_)) {}

ChildProcess::~ChildProcess() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    wait(kReapingLimit);
  }
}

std::optional<std::string> ChildProcess::wait(std::chrono::milliseconds limit) {
  if (id_ <= 0) return "has ended";
  // Readable, it has ended, and waiting for it does not block but for the kernel's last touch.
  const int how = is_readable(end_.number(), limit) ? 0 : WNOHANG;
  int status = 0;
  pid_t reaped = -1;
  do {
    reaped = ::waitpid(id_, &status, how);
  } while (reaped < 0 && errno == EINTR);
  if (reaped == 0) return std::nullopt;
  id_ = -1;
  if (reaped < 0) return "has ended";  // where this process is set to have no zombies
  constexpr int kNotLoaded = 127;      // said by the dynamic linker
  if (WIFEXITED(status)) {
    return fmt::format("ended with code {}{}", WEXITSTATUS(status),
                       WEXITSTATUS(status) == kNotLoaded ? ", for a library of it is missing" : "");
  }
  const int signal = WTERMSIG(status);
  const char* name = ::sigdescr_np(signal);
  return fmt::format("was ended by signal {} ({})", signal, name != nullptr ? name : "unknown");
}

}  // namespace instep
