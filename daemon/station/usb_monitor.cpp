#include "daemon/station/usb_monitor.h"

#include <sys/epoll.h>

#include <utility>

namespace instep {

UsbMonitor::UsbMonitor(EventLoop& loop, Result<std::unique_ptr<UsbWatch>> watch, OnChange on_change)
    : on_change_(std::move(on_change)) {
  if (!watch) return;
  auto readable = loop.watch((*watch)->descriptor(), EPOLLIN, [this](std::uint32_t) { read(); });
  if (!readable) return;
  watch_ = std::move(*watch);
  readable_ = std::move(*readable);
  settle_timer_ = loop.timer([this] { settle(); });
  read();
}

void UsbMonitor::read() {
  const auto now = EventLoop::monotonic_now();
  for (const auto& change : watch_->changes()) presence_.note(change, now);
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
