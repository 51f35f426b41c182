#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstring>
#include <deque>
#include <filesystem>
#include <future>
#include <mutex>
#include <string>
#include <utility>

#include "drivers/files/descriptor.h"
#include "drivers/files/wake_up.h"

namespace instep::test {

/// The socket on which systemd would hear the service. It is read all the time, as systemd does:
/// the kernel keeps ten messages, and a service that has more to say waits.
class Notifications {
 public:
  explicit Notifications(const std::filesystem::path& path)
      : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.c_str(), path.string().size());
    EXPECT_EQ(::bind(socket_.number(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    reading_ = std::async(std::launch::async, [this] { read_to_the_end(); });
  }
  ~Notifications() {
    end_.set();
    reading_.wait();
  }
  Notifications(const Notifications&) = delete;
  Notifications& operator=(const Notifications&) = delete;

  /// True as soon as a message holds `text`, of those behind the last that was waited for.
  bool wait_for(const std::string& text, std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    return came_.wait_for(lock, limit, [&] {
      while (!said_.empty()) {
        const std::string message = std::move(said_.front());
        said_.pop_front();
        if (message.find(text) != std::string::npos) return true;
      }
      return false;
    });
  }

  void forget() {
    const std::lock_guard lock(mutex_);
    take_all();
    said_.clear();
  }

 private:
  void read_to_the_end() {
    std::array<pollfd, 2> waiting{{{socket_.number(), POLLIN, 0}, {end_.descriptor(), POLLIN, 0}}};
    while (waiting[1].revents == 0) {
      ::poll(waiting.data(), waiting.size(), -1);
      const std::lock_guard lock(mutex_);
      take_all();
      came_.notify_all();
    }
  }

  void take_all() {
    std::array<char, 4096> message;
    while (true) {
      const auto got = ::recv(socket_.number(), message.data(), message.size(), MSG_DONTWAIT);
      if (got < 0) return;
      said_.emplace_back(message.data(), static_cast<std::size_t>(got));
    }
  }

  Descriptor socket_;
  WakeUp end_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable came_;
  std::deque<std::string> said_;
  std::future<void> reading_;
};

}  // namespace instep::test
