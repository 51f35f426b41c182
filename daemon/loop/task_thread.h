#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace instep {

/// Counts the steps of a task, so that the watchdog can tell a long one from a hung one.
class TaskProgress {
 public:
  void step() { steps_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t steps() const { return steps_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> steps_{0};
};

/// One thread that does tasks in the order they are posted. A task that never ends cannot be
/// stopped in C++; it is left behind, with what it holds, and the thread is told to be hung by
/// is_busy() and a progress that stands still. So tasks own, by shared_ptr, whatever they touch.
class TaskThread {
 public:
  using Task = std::function<void(TaskProgress&)>;

  explicit TaskThread(const std::string& name);
  /// stop() with a limit of one second.
  ~TaskThread();
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;

  /// Ignored after close(), stop() and finish().
  void post(Task task);

  /// Takes no more tasks: the thread ends after those it has, for which finish() waits.
  void close();

  /// Drops waiting tasks and waits for the running one. False if it did not end within the limit;
  /// the thread is then abandoned. One that is in the middle of nothing is let go, and ends by
  /// itself.
  bool stop(std::chrono::milliseconds limit);
  /// The same for several threads that are to end by one moment; one that has ended is never late.
  bool stop_by(std::chrono::steady_clock::time_point deadline);

  /// Takes no more tasks and waits for those it has. False if they did not end within the limit;
  /// the thread is then abandoned with them, and does them yet if it can. No call but the
  /// destructor may follow.
  bool finish(std::chrono::milliseconds limit);
  /// As stop_by() is to stop().
  bool finish_by(std::chrono::steady_clock::time_point deadline);

  /// A task runs or waits.
  bool is_busy() const;
  std::uint64_t progress() const;

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);
  /// Waits until the thread ends, and gives it up at the limit. False if it has tasks still.
  bool leave(std::unique_lock<std::mutex> lock, std::chrono::milliseconds limit);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace instep
