#include "daemon/station/usb_monitor.h"

#include <sys/epoll.h>

#include <utility>

#include "daemon/loop/caught.h"

namespace instep {
namespace {

/// None if memory is short: the next event is told all the same.
std::vector<UsbChange> changes_of(UsbWatch& watch) {
  const auto changes = caught("a look at the USB bus",
                              [&]() -> Result<std::vector<UsbChange>> { return watch.changes(); });
  return changes.value_or(std::vector<UsbChange>());
}

}  // namespace

UsbMonitor::UsbMonitor(EventLoop& loop, Open open, OnChange on_change)
    : loop_(loop),
      on_change_(std::move(on_change)),
      watch_(std::make_shared<std::unique_ptr<UsbWatch>>()) {
  settle_timer_ = loop_.timer([this] { settle(); });
  thread_.post(
      [this, watch = watch_, open = std::move(open), post = loop_.poster()](TaskProgress&) {
        auto opened = caught("the watch of the USB bus", open);
        if (!opened) return;
        *watch = std::move(*opened);
        post([this, descriptor = (*watch)->descriptor()] { begin(descriptor); });
      });
}

void UsbMonitor::put_off() {
  readable_ = {};
  thread_.post([watch = watch_](TaskProgress&) { watch->reset(); });
  thread_.close();
}

bool UsbMonitor::end_by(std::chrono::steady_clock::time_point deadline) {
  put_off();
  return thread_.finish_by(deadline);
}

void UsbMonitor::begin(int descriptor) {
  auto readable = loop_.watch(descriptor, EPOLLIN, [this](std::uint32_t) { read(); });
  if (!readable) return;
  readable_ = std::move(*readable);
  read();
}

void UsbMonitor::read() {
  readable_.set_events(0);
  thread_.post([this, watch = watch_, post = loop_.poster()](TaskProgress&) {
    post([this, changes = changes_of(**watch)] { take(changes); });
  });
}

void UsbMonitor::take(const std::vector<UsbChange>& changes) {
  readable_.set_events(EPOLLIN);
  const auto now = EventLoop::monotonic_now();
  for (const auto& change : changes) presence_.note(change, now);
  wait();
}

void UsbMonitor::settle() {
  for (const auto& change : presence_.settled(EventLoop::monotonic_now())) on_change_(change);
  wait();
}

void UsbMonitor::wait() {
  if (const auto deadline = presence_.next_deadline()) {
    settle_timer_.set_at(*deadline);
  } else {
    settle_timer_.clear();
  }
}

}  // namespace instep
