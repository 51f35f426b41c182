#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "daemon/station/usb_presence.h"
#include "drivers/usb_watch.h"

namespace instep {

/// The USB bus on the event loop: tells of devices that came or went, once each. Where the bus
/// cannot be watched nothing is told.
///
/// What is asked of a device waits while its driver is at it, which a faulty one holds up for ever:
/// so the watch has a thread of its own, and where that hangs nothing more is told. Lives on the
/// loop's thread, where no call but end_by() waits, and longer than the loop runs.
class UsbMonitor {
 public:
  /// Called on the watch's thread.
  using Open = std::function<Result<std::unique_ptr<UsbWatch>>()>;
  using OnChange = std::function<void(const UsbChange&)>;

  UsbMonitor(EventLoop& loop, Open open, OnChange on_change);

  /// Has the watch closed; the loop has ended, and no call but end_by() may follow.
  void put_off();
  /// The same, and waits for it; false if it hangs and had to be left behind. No call but the
  /// destructor may follow.
  bool end_by(std::chrono::steady_clock::time_point deadline);

 private:
  void begin(int descriptor);
  void read();
  void take(const std::vector<UsbChange>& changes);
  void settle();
  void wait();

  EventLoop& loop_;
  OnChange on_change_;
  UsbPresence presence_;
  EventLoop::Watch readable_;
  EventLoop::Timer settle_timer_;
  std::shared_ptr<std::unique_ptr<UsbWatch>> watch_;  ///< the thread's, to its end
  TaskThread thread_{"usb watch"};
};

}  // namespace instep
