#pragma once

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

namespace instep::test {

/// Cuts short what the thread that made it waits for, again and again while it is there.
class SignalRain {
 public:
  SignalRain() {
    struct sigaction without_restart {};
    without_restart.sa_handler = [](int) {};
    ::sigaction(SIGUSR2, &without_restart, &before_);
    cloud_ = std::thread([this, wetted = ::pthread_self()] {
      while (!over_) {
        ::pthread_kill(wetted, SIGUSR2);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
  }
  ~SignalRain() {
    over_ = true;
    cloud_.join();
    ::sigaction(SIGUSR2, &before_, nullptr);
  }
  SignalRain(const SignalRain&) = delete;
  SignalRain& operator=(const SignalRain&) = delete;

 private:
  struct sigaction before_ {};
  std::atomic<bool> over_ = false;
  std::thread cloud_;
};

}  // namespace instep::test
