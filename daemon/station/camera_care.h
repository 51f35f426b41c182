#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "daemon/loop/event_loop.h"
#include "daemon/loop/task_thread.h"
#include "daemon/station/recovery_ladder.h"
#include "daemon/station/usb_monitor.h"
#include "drivers/usb/usb_device.h"

namespace instep {

/// What is told of a camera beside its trouble.
struct CameraHealth {
  std::string recovery{};  ///< how far getting it back has gone; empty if nothing is wrong
  int link_mbps = 0;       ///< of its USB link; 0 = unknown
  std::string warning{};   ///< it serves, but not as well as it could
};

/// Gets cameras back: climbs the recovery ladder of each, resets it on its bus where that is next,
/// and asks for a look at once when the bus tells that one came or left. Lives on the loop's
/// thread; no call waits.
class CameraCare {
 public:
  struct Listener {
    std::function<void()> look;       ///< look at the cameras now, and tell by looked_at()
    std::function<void()> on_change;  ///< health() says something new
  };
  /// The USB bus; another one in tests.
  struct Bus {
    // Each is called on a thread of its own.
    UsbMonitor::Open watch;
    std::function<Result<void>(const UsbAddress&)> reset;
  };
  static Bus real_bus();

  /// Nothing instead of an address = not on the USB bus.
  CameraCare(EventLoop& loop, const std::vector<std::optional<UsbAddress>>& cameras,
             Listener listener, Bus bus = real_bus());

  /// As those of UsbMonitor.
  void put_off_watch();
  bool end_watch_by(std::chrono::steady_clock::time_point deadline);
  /// Waits for a reset that runs; false if it had to be left behind.
  bool end_by(std::chrono::steady_clock::time_point deadline) {
    return reset_thread_.stop_by(deadline);
  }

  void looked_at(std::size_t camera, const std::optional<Error>& trouble);
  const CameraHealth& health(std::size_t camera) const { return patients_[camera].health; }

 private:
  struct Patient {
    std::optional<UsbAddress> address;
    RecoveryLadder ladder;
    CameraHealth health{};
    bool in_trouble = true;  ///< until it was looked at
    std::optional<std::chrono::nanoseconds> last_reset{};
  };

  void reset(std::size_t camera);
  void bus_changed(const UsbChange& change);

  EventLoop& loop_;
  Listener listener_;
  Bus bus_;
  std::vector<Patient> patients_;
  std::optional<UsbMonitor> monitor_;
  TaskThread reset_thread_{"usb reset"};
};

}  // namespace instep
