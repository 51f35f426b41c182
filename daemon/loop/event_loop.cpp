#include "daemon/loop/event_loop.h"

#include <sys/epoll.h>
#include <systemd/sd-event.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>

#include "drivers/files/wake_up.h"

namespace instep {
namespace {

Error refused(int negative_errno) {
  return Error{ErrorCode::kIo, Remedy::kOperator,
               std::string("the event loop fails: ") + std::strerror(-negative_errno),
               "check the limits on open files and memory"};
}

std::uint64_t microseconds(std::chrono::nanoseconds time) {
  const auto rounded_up = std::chrono::ceil<std::chrono::microseconds>(time).count();
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, rounded_up));
}

}  // namespace

/// What other threads have posted, and what tells of it.
struct EventLoop::Mailbox {
  WakeUp mail;
  std::mutex mutex;
  std::vector<std::function<void()>> tasks;
  bool closed = false;

  void put(std::function<void()> task) {
    const std::lock_guard lock(mutex);
    if (closed) return;
    tasks.push_back(std::move(task));
    mail.set();
  }

  std::vector<std::function<void()>> take() {
    const std::lock_guard lock(mutex);
    mail.clear();
    return std::exchange(tasks, {});
  }

  /// The tasks end when nothing is locked any more.
  void close() {
    std::vector<std::function<void()>> dropped;
    const std::lock_guard lock(mutex);
    closed = true;
    dropped.swap(tasks);
  }
};

struct EventLoop::SignalHandler {
  sd_event_source* source = nullptr;
  std::function<void()> on_signal;
  ~SignalHandler() { sd_event_source_disable_unref(source); }
};

struct EventLoop::Watch::State {
  sd_event_source* source = nullptr;
  std::function<void(std::uint32_t)> on_ready;
  ~State() { sd_event_source_disable_unref(source); }
};

struct EventLoop::Timer::State {
  sd_event_source* source = nullptr;
  std::function<void()> on_time;
  ~State() { sd_event_source_disable_unref(source); }
};

Result<std::unique_ptr<EventLoop>> EventLoop::create() {
  std::unique_ptr<EventLoop> loop(new EventLoop);
  if (const auto opened = loop->open(); !opened) return tl::make_unexpected(opened.error());
  return loop;
}

Result<void> EventLoop::open() {
  if (const int failed = sd_event_new(&event_); failed < 0) {
    return tl::make_unexpected(refused(failed));
  }
  mailbox_ = std::make_shared<Mailbox>();
  if (!mailbox_->mail.is_open()) return tl::make_unexpected(refused(-errno));
  const std::weak_ptr<Mailbox> weak = mailbox_;
  auto watching = watch(mailbox_->mail.descriptor(), EPOLLIN, [weak](std::uint32_t) {
    const auto mailbox = weak.lock();
    if (!mailbox) return;
    for (auto& task : mailbox->take()) task();
  });
  if (!watching) return tl::make_unexpected(watching.error());
  mail_watch_ = std::move(*watching);
  auto first = make_timer([] {});
  if (!first) return tl::make_unexpected(first.error());
  first_timer_ = std::move(*first);
  return {};
}

EventLoop::~EventLoop() {
  // What the tasks hold may post once more as it ends.
  if (mailbox_) mailbox_->close();
  signal_handlers_.clear();
  mail_watch_ = {};
  first_timer_ = {};
  sd_event_unref(event_);
}

Result<void> EventLoop::run() {
  const int failed = sd_event_loop(event_);
  if (failed < 0) return tl::make_unexpected(refused(failed));
  return {};
}

void EventLoop::leave() {
  sd_event_exit(event_, 0);
}

EventLoop::Post EventLoop::poster() const {
  return [mailbox = mailbox_](std::function<void()> task) { mailbox->put(std::move(task)); };
}

Result<EventLoop::Watch> EventLoop::watch(int descriptor, std::uint32_t events,
                                          std::function<void(std::uint32_t)> on_ready) {
  Watch watch;
  watch.state_ = std::make_shared<Watch::State>();
  watch.state_->on_ready = std::move(on_ready);
  const auto ring = [](sd_event_source*, int, std::uint32_t ready, void* user) {
    // A callback may drop the very watch that called it: its copy keeps it whole until the end.
    const auto callback = static_cast<Watch::State*>(user)->on_ready;
    callback(ready);
    return 0;
  };
  const int failed =
      sd_event_add_io(event_, &watch.state_->source, descriptor, events, ring, watch.state_.get());
  if (failed < 0) return tl::make_unexpected(refused(failed));
  return watch;
}

void EventLoop::Watch::set_events(std::uint32_t events) {
  if (state_) sd_event_source_set_io_events(state_->source, events);
}

EventLoop::Timer EventLoop::timer(std::function<void()> on_time) {
  auto timer = make_timer(std::move(on_time));
  if (!timer) throw std::bad_alloc();
  return std::move(*timer);
}

Result<EventLoop::Timer> EventLoop::make_timer(std::function<void()> on_time) {
  Timer timer;
  timer.state_ = std::make_shared<Timer::State>();
  timer.state_->on_time = std::move(on_time);
  const auto ring = [](sd_event_source*, std::uint64_t, void* user) {
    const auto callback = static_cast<Timer::State*>(user)->on_time;
    callback();
    return 0;
  };
  constexpr std::uint64_t kAccuracy = 1000;
  const int failed = sd_event_add_time(event_, &timer.state_->source, CLOCK_MONOTONIC, 0, kAccuracy,
                                       ring, timer.state_.get());
  if (failed < 0) return tl::make_unexpected(refused(failed));
  timer.clear();
  return timer;
}

void EventLoop::Timer::set(std::chrono::nanoseconds from_now) {
  set_at(monotonic_now() + from_now);
}

void EventLoop::Timer::set_at(std::chrono::nanoseconds monotonic_time) {
  if (!state_) return;
  sd_event_source_set_time(state_->source, microseconds(monotonic_time));
  sd_event_source_set_enabled(state_->source, SD_EVENT_ONESHOT);
}

void EventLoop::Timer::clear() {
  if (state_) sd_event_source_set_enabled(state_->source, SD_EVENT_OFF);
}

Result<void> EventLoop::on_signal(int signal, std::function<void()> on_signal) {
  auto handler = std::make_unique<SignalHandler>();
  handler->on_signal = std::move(on_signal);
  const auto ring = [](sd_event_source*, const struct signalfd_siginfo*, void* user) {
    static_cast<SignalHandler*>(user)->on_signal();
    return 0;
  };
  const int failed = sd_event_add_signal(event_, &handler->source, signal, ring, handler.get());
  if (failed < 0) return tl::make_unexpected(refused(failed));
  signal_handlers_.push_back(std::move(handler));
  return {};
}

std::chrono::nanoseconds EventLoop::monotonic_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

}  // namespace instep
