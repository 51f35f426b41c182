#pragma once

#include <string>
#include <vector>

namespace instep::test {

/// What a program did.
struct ProgramRun {
  int exit_code = -1;  ///< 128 + the signal if it was killed
  std::string output;
  std::string errors;
};

/// Where the program's stdout goes. What a terminal got is in ProgramRun::output as well.
enum class Stdout { kCaptured, kTerminal, kClosed, kFullDisk };

/// Runs one of this project's programs with arguments, with no terminal but for kTerminal; throws
/// if it cannot start.
ProgramRun run_program(const std::string& name, const std::vector<std::string>& arguments,
                       Stdout to = Stdout::kCaptured);

}  // namespace instep::test
