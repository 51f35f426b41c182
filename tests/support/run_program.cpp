#include "tests/support/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "tests/support/start_program.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {
namespace {

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A terminal of which a program is to have the other end.
class PseudoTerminal {
 public:
  PseudoTerminal() : end_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (end_ < 0 || ::grantpt(end_) != 0 || ::unlockpt(end_) != 0) {
      throw std::runtime_error("there is no terminal to be had");
    }
  }
  ~PseudoTerminal() { ::close(end_); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  std::string other_end() const { return ::ptsname(end_); }
  /// All that is written until the last who has the other end closes it.
  std::string read_all() const {
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t got = 0; (got = ::read(end_, piece.data(), piece.size())) > 0;) {
      text.append(piece.data(), static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int end_;
};

}  // namespace

ProgramRun run_program(const std::string& name, const std::vector<std::string>& arguments,
                       Stdout to) {
  const TemporaryFolder folder;
  std::optional<PseudoTerminal> terminal;
  if (to == Stdout::kTerminal) terminal.emplace();
  const std::string output = terminal                  ? terminal->other_end()
                             : to == Stdout::kFullDisk ? "/dev/full"
                                                       : (folder.path() / "output").string();
  const std::string errors = folder.path() / "errors";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_NOCTTY, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT,
                                   0600);
  if (to == Stdout::kClosed) posix_spawn_file_actions_addclose(&actions, STDOUT_FILENO);
  const pid_t child = start_program(name, arguments, actions);
  const std::string shown = terminal ? terminal->read_all() : "";
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          to == Stdout::kCaptured ? text_of(output) : shown, text_of(errors)};
}

}  // namespace instep::test
