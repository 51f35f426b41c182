#include "tests/support/background_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "tests/support/start_program.h"

namespace instep::test {

BackgroundProgram::BackgroundProgram(const std::string& name,
                                     const std::vector<std::string>& arguments,
                                     std::filesystem::path errors)
    : errors_(std::move(errors)) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors_.c_str(), O_WRONLY | O_CREAT,
                                   0600);
  process_ = start_program(name, arguments, actions);
}

BackgroundProgram::~BackgroundProgram() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void BackgroundProgram::signal(int number) const {
  ::kill(process_, number);
}

int BackgroundProgram::wait_for_end() {
  int status = -1;
  for (int i = 0; i < 2000 && process_ > 0; ++i) {
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      return status;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return -1;
}

std::string BackgroundProgram::errors() const {
  std::ifstream stream(errors_);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace instep::test
