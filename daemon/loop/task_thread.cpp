#include "daemon/loop/task_thread.h"

#include <pthread.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

namespace instep {
namespace {

/// Never none, as one that has ended is to be found so.
std::chrono::milliseconds time_until(std::chrono::steady_clock::time_point deadline) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  return std::max(left, std::chrono::milliseconds(1));
}

}  // namespace

struct TaskThread::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Task> tasks;
  bool running = false;
  bool stopping = false;
  bool ended = false;
  TaskProgress progress;
};

TaskThread::TaskThread(const std::string& name) : shared_(std::make_shared<Shared>()) {
  thread_ = std::thread([shared = shared_] { run(shared); });
  pthread_setname_np(thread_.native_handle(), name.substr(0, 15).c_str());
}

TaskThread::~TaskThread() {
  stop(std::chrono::seconds(1));
}

void TaskThread::run(const std::shared_ptr<Shared>& shared) {
  std::unique_lock lock(shared->mutex);
  while (true) {
    shared->changed.wait(lock, [&] { return shared->stopping || !shared->tasks.empty(); });
    if (shared->tasks.empty()) break;
    {
      const Task task = std::move(shared->tasks.front());
      shared->tasks.pop_front();
      shared->running = true;
      lock.unlock();
      shared->progress.step();
      task(shared->progress);
      shared->progress.step();
    }
    lock.lock();
    shared->running = false;
  }
  shared->ended = true;
  shared->changed.notify_all();
}

void TaskThread::post(Task task) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->stopping) return;
  shared_->tasks.push_back(std::move(task));
  shared_->changed.notify_all();
}

void TaskThread::close() {
  const std::lock_guard lock(shared_->mutex);
  shared_->stopping = true;
  shared_->changed.notify_all();
}

bool TaskThread::stop(std::chrono::milliseconds limit) {
  if (!thread_.joinable()) return true;
  std::deque<Task> dropped;
  std::unique_lock lock(shared_->mutex);
  dropped.swap(shared_->tasks);
  return leave(std::move(lock), limit);
}

bool TaskThread::stop_by(std::chrono::steady_clock::time_point deadline) {
  return stop(time_until(deadline));
}

bool TaskThread::finish(std::chrono::milliseconds limit) {
  if (!thread_.joinable()) return true;
  return leave(std::unique_lock(shared_->mutex), limit);
}

bool TaskThread::finish_by(std::chrono::steady_clock::time_point deadline) {
  return finish(time_until(deadline));
}

bool TaskThread::leave(std::unique_lock<std::mutex> lock, std::chrono::milliseconds limit) {
  shared_->stopping = true;
  shared_->changed.notify_all();
  const bool ended = shared_->changed.wait_for(lock, limit, [&] { return shared_->ended; });
  // On a busy machine its turn to end may be yet to come.
  const bool is_done = !shared_->running && shared_->tasks.empty();
  lock.unlock();
  if (ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
  return is_done;
}

bool TaskThread::is_busy() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->running || !shared_->tasks.empty();
}

std::uint64_t TaskThread::progress() const {
  return shared_->progress.steps();
}

}  // namespace instep
