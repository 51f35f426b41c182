#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace instep::test {

/// One of this project's programs under way, killed at the end of the scope if it still runs. What
/// it says on stderr goes to a file.
class BackgroundProgram {
 public:
  /// Throws if it cannot start.
  BackgroundProgram(const std::string& name, const std::vector<std::string>& arguments,
                    std::filesystem::path errors);
  ~BackgroundProgram();
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  void signal(int number) const;
  /// As waitpid() tells it; -1 if it runs on for 20 s.
  int wait_for_end();
  std::string errors() const;

 private:
  std::filesystem::path errors_;
  pid_t process_ = -1;
};

}  // namespace instep::test
