#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace instep {

/// What the daemon tells systemd (sd_notify); without systemd every call does nothing.
class ServiceManager {
 public:
  void ready(const std::string& status);
  void reloading();
  void stopping();
  /// The text behind "Status:" of systemctl; sent when it changes.
  void status(const std::string& text);
  void feed_watchdog();

  /// How long systemd waits to be fed; nothing if it does not watch.
  static std::optional<std::chrono::microseconds> watchdog_limit();

 private:
  std::string status_;
};

}  // namespace instep
