#pragma once

#include <mutex>
#include <string>
#include <utility>

#include "sim/openni2_module/bus_folder.h"

namespace instep {

/// A sensor's place on the bus: written by the thread that watches the bus, read by the threads of
/// its device and stream.
class Plug {
 public:
  explicit Plug(BusDevice device) : device_(std::move(device)) {}

  BusDevice device() const {
    const std::lock_guard lock(mutex_);
    return device_;
  }
  void change(BusDevice device) {
    const std::lock_guard lock(mutex_);
    device_ = std::move(device);
  }
  bool has(const std::string& fault) const {
    const std::lock_guard lock(mutex_);
    return device_.has(fault);
  }

  bool is_in() const {
    const std::lock_guard lock(mutex_);
    return in_;
  }
  void pull() {
    const std::lock_guard lock(mutex_);
    in_ = false;
  }

 private:
  mutable std::mutex mutex_;
  BusDevice device_;
  bool in_ = true;
};

}  // namespace instep
