#pragma once

#include <functional>
#include <memory>

#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/station/usb_presence.h"
#include "drivers/usb_watch.h"

namespace instep {

/// The USB bus on the event loop: tells of devices that came or went, once each. Where the bus
/// cannot be watched nothing is told. Lives on the loop's thread.
class UsbMonitor {
 public:
  using OnChange = std::function<void(const UsbChange&)>;

  UsbMonitor(EventLoop& loop, Result<std::unique_ptr<UsbWatch>> watch, OnChange on_change);

 private:
  void read();
  void settle();
  void wait();

  std::unique_ptr<UsbWatch> watch_;
  OnChange on_change_;
  UsbPresence presence_;
  EventLoop::Watch readable_;
  EventLoop::Timer settle_timer_;
};

}  // namespace instep
