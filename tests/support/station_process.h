#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "daemon/control/control_client.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace instep::test {

/// The real instepd in a folder of its own, watched through its notifications as systemd would.
class StationProcess {
 public:
  /// A small simulated station that loses no time; `more` is added to its settings.
  explicit StationProcess(const std::string& more_settings = "");
  /// Kills it if it still runs.
  ~StationProcess();
  StationProcess(const StationProcess&) = delete;
  StationProcess& operator=(const StationProcess&) = delete;

  void write_settings(const std::string& toml) const;
  /// Runs the programs of that folder; those of this build if it is never called.
  void set_programs(const std::filesystem::path& folder) { programs_ = folder; }
  static std::string small_settings();
  /// The smallest station that still gives a result: for tests that start it hundreds of times.
  static std::string tiny_settings();

  void start(std::optional<std::chrono::microseconds> watchdog = std::nullopt);
  void signal(int number) const;
  /// The exit code, or minus the signal that ended it; nothing if it runs on.
  std::optional<int> wait_for_exit(std::chrono::milliseconds limit);
  pid_t process() const { return process_; }

  /// True once a notification has held `text` (such as "READY=1", "STATUS=ready").
  bool wait_for(const std::string& text, std::chrono::milliseconds limit);

  Result<ControlClient> connect() const {
    return ControlClient::connect(folder() / "control.sock");
  }
  /// Runs `instep` with these arguments against it.
  struct Output {
    int exit_code = -1;
    std::string text;  ///< stdout and stderr
  };
  Output run_instep(const std::string& arguments) const;
  void tap_pedal() const;

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path store() const { return store_; }
  void set_store(const std::filesystem::path& store) { store_ = store; }
  std::string log() const;

 private:
  TemporaryFolder folder_;
  std::filesystem::path store_;
  std::filesystem::path programs_ = built_programs();
  /// Reads notifications as they come: a full socket would hold up the daemon.
  void read_notifications();
  void take_waiting();

  int notifications_ = -1;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string notified_;
  std::atomic<bool> ending_ = false;
  std::thread reader_;
  pid_t process_ = -1;
};

}  // namespace instep::test
