#include "tests/support/background_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/support/places.h"

namespace instep::test {

BackgroundProgram::BackgroundProgram(const std::string& name,
                                     const std::vector<std::string>& arguments,
                                     std::filesystem::path errors)
    : errors_(std::move(errors)) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), name);
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors_.c_str(), O_WRONLY | O_CREAT,
                                   0600);
  const auto program = built_programs() / name;
  const int failure =
      posix_spawn(&process_, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " + program.string());
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
