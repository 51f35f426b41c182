#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/places.h"
#include "tests/support/station_process.h"
#include "tests/support/temporary_folder.h"

namespace instep {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

bool holds_a_frame(const fs::path& folder) {
  std::error_code away;
  for (fs::recursive_directory_iterator at(folder, away), end; !away && at != end;
       at.increment(away)) {
    if (at->path().extension() == ".png") return true;
  }
  return false;
}

/// A recording under way that would take minutes.
class LongRecording {
 public:
  explicit LongRecording(const fs::path& folder) : errors_(folder / "errors") {
    const auto settings = folder / "s.toml";
    std::ofstream(settings) << test::StationProcess::tiny_settings();
    std::vector<std::string> words = {"instep",   "record", "--out",    folder / "visit",
                                      "--config", settings, "--frames", "10000"};
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors_.c_str(), O_WRONLY | O_CREAT,
                                     0600);
    const auto program = test::built_programs() / "instep";
    EXPECT_EQ(posix_spawn(&process_, program.c_str(), &actions, nullptr, pointers.data(), environ),
              0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~LongRecording() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  LongRecording(const LongRecording&) = delete;
  LongRecording& operator=(const LongRecording&) = delete;

  void signal(int number) const { kill(process_, number); }
  /// As waitpid() tells it; -1 if it runs on.
  int wait_for_end() {
    int status = -1;
    for (int i = 0; i < 2000 && process_ > 0; ++i) {
      if (waitpid(process_, &status, WNOHANG) == process_) {
        process_ = -1;
        return status;
      }
      std::this_thread::sleep_for(10ms);
    }
    return -1;
  }
  std::string errors() const {
    std::ifstream stream(errors_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  fs::path errors_;
  pid_t process_ = -1;
};

TEST(Record, EndsByItselfAtASignalInOneLineAndKeepsNothing) {
  for (const int number : {SIGINT, SIGTERM}) {
    const test::TemporaryFolder folder;
    LongRecording recording(folder.path());
    for (int i = 0; i < 2000 && !holds_a_frame(folder.path() / "visit"); ++i) {
      std::this_thread::sleep_for(10ms);
    }
    ASSERT_TRUE(holds_a_frame(folder.path() / "visit")) << recording.errors();
    recording.signal(number);
    const int status = recording.wait_for_end();
    ASSERT_TRUE(WIFEXITED(status)) << status;
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(recording.errors(),
              "instep: the recording was stopped, nothing of it is kept: record again when you are "
              "ready\n");
    EXPECT_FALSE(fs::exists(folder.path() / "visit"));
  }
}

}  // namespace
}  // namespace instep
