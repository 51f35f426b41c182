#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>

#include "daemon/loop/event_loop.h"

namespace instep::test {

/// An event loop at work on a thread of its own.
class LoopThread {
 public:
  LoopThread() : thread_([this] { [[maybe_unused]] const auto ended = loop_->run(); }) {}
  ~LoopThread() { stop(); }
  LoopThread(const LoopThread&) = delete;
  LoopThread& operator=(const LoopThread&) = delete;

  EventLoop& loop() { return *loop_; }
  /// Ends the loop: what lives on it can be taken down.
  void stop() {
    if (!thread_.joinable()) return;
    loop_->poster()([this] { loop_->leave(); });
    thread_.join();
  }
  /// Does it on the loop.
  void call(const std::function<void()>& task) {
    const auto done = std::make_shared<std::promise<void>>();
    loop_->poster()([&task, done] {
      task();
      done->set_value();
    });
    done->get_future().wait();
  }
  /// Looks on the loop until it holds; false if that takes longer than 10 s.
  bool wait_until(const std::function<bool()>& holds) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    bool held = false;
    while (!held && std::chrono::steady_clock::now() < deadline) {
      call([&] { held = holds(); });
      if (!held) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return held;
  }

 private:
  std::unique_ptr<EventLoop> loop_ = EventLoop::create().value();
  std::thread thread_;
};

}  // namespace instep::test
