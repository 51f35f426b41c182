#include "tests/support/start_program.h"

#include <unistd.h>

#include <stdexcept>

#include "tests/support/places.h"

namespace instep::test {

pid_t start_program(const std::string& name, const std::vector<std::string>& arguments,
                    posix_spawn_file_actions_t& actions) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), name);
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string program = built_programs() / name;
  pid_t process = -1;
  const int failure =
      posix_spawn(&process, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " + program);
  return process;
}

}  // namespace instep::test
