#include "tests/support/station_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace instep::test {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

StationProcess::StationProcess(const std::string& more_settings) {
  store_ = folder() / "scans";
  write_settings(small_settings() + more_settings);
  notifications_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = folder() / "notify.sock";
  std::memcpy(address.sun_path, path.c_str(), path.size());
  if (::bind(notifications_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot listen on " + path);
  }
  reader_ = std::thread([this] { read_notifications(); });
}

StationProcess::~StationProcess() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ending_ = true;
  reader_.join();
  ::close(notifications_);
}

void StationProcess::write_settings(const std::string& toml) const {
  std::ofstream(folder() / "instep.toml") << toml;
}

std::string StationProcess::small_settings() {
  return "[[camera]]\nkind = \"simulated\"\n"
         "[capture]\nframes_per_camera = 4\nwarmup_frames = 0\n"
         "[simulation]\nwidth_px = 320\nheight_px = 240\npacing = \"fast\"\ntruth = false\n";
}

std::string StationProcess::tiny_settings() {
  return "[[camera]]\nkind = \"simulated\"\n"
         "[capture]\nframes_per_camera = 2\nwarmup_frames = 0\n"
         "[simulation]\nwidth_px = 160\nheight_px = 120\ncameras = 3\npacing = \"fast\"\n"
         "truth = false\n";
}

void StationProcess::start(std::optional<std::chrono::microseconds> watchdog) {
  {
    // What an earlier run has said is not about this one.
    const std::lock_guard lock(mutex_);
    take_waiting();
    notified_.clear();
  }
  std::vector<std::string> environment = {"NOTIFY_SOCKET=" + (folder() / "notify.sock").string(),
                                          "INSTEP_CONFIG=" + (folder() / "instep.toml").string(),
                                          "INSTEP_STORE=" + store_.string(),
                                          "INSTEP_SOCKET=" + (folder() / "control.sock").string(),
                                          "INSTEP_PEDAL=" + (folder() / "pedal").string(),
                                          "PATH=/usr/bin:/bin"};
  if (watchdog) environment.push_back("WATCHDOG_USEC=" + std::to_string(watchdog->count()));
  std::vector<char*> pointers;
  for (auto& variable : environment) pointers.push_back(variable.data());
  pointers.push_back(nullptr);
  const std::string program = programs_ / "instepd";
  const std::string log = folder() / "instepd.log";

  process_ = ::fork();
  if (process_ == 0) {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    ::dup2(file, STDERR_FILENO);
    ::execle(program.c_str(), "instepd", nullptr, pointers.data());
    ::_exit(127);
  }
}

void StationProcess::signal(int number) const {
  ::kill(process_, number);
}

std::optional<int> StationProcess::wait_for_exit(milliseconds limit) {
  const auto deadline = steady_clock::now() + limit;
  int status = 0;
  while (::waitpid(process_, &status, WNOHANG) == 0) {
    if (steady_clock::now() >= deadline) return std::nullopt;
    ::poll(nullptr, 0, 1);
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool StationProcess::wait_for(const std::string& text, milliseconds limit) {
  std::unique_lock lock(mutex_);
  auto found = std::string::npos;
  const bool came = changed_.wait_for(lock, limit, [&] {
    found = notified_.find(text);
    return found != std::string::npos;
  });
  if (came) notified_.erase(0, found + text.size());
  return came;
}

void StationProcess::read_notifications() {
  while (!ending_) {
    pollfd waiting{notifications_, POLLIN, 0};
    if (::poll(&waiting, 1, 20) <= 0) continue;
    const std::lock_guard lock(mutex_);
    take_waiting();
    changed_.notify_all();
  }
}

void StationProcess::take_waiting() {
  std::array<char, 4096> message;
  while (true) {
    const auto got = ::recv(notifications_, message.data(), message.size(), MSG_DONTWAIT);
    if (got < 0) return;
    notified_ += std::string(message.data(), static_cast<std::size_t>(got)) + "\n";
  }
}

StationProcess::Output StationProcess::run_instep(const std::string& arguments) const {
  const std::string command = "INSTEP_SOCKET=" + (folder() / "control.sock").string() +
                              " INSTEP_STORE=" + store_.string() +
                              " INSTEP_CONFIG=" + (folder() / "instep.toml").string() + " " +
                              (programs_ / "instep").string() + " " + arguments + " 2>&1";
  Output output;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> block;
  while (const auto got = std::fread(block.data(), 1, block.size(), pipe)) {
    output.text.append(block.data(), got);
  }
  const int status = ::pclose(pipe);
  output.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

void StationProcess::tap_pedal() const {
  std::ofstream(folder() / "pedal") << "tap\n";
}

std::string StationProcess::log() const {
  std::ifstream stream(folder() / "instepd.log");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace instep::test
