#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "drivers/files/descriptor.h"
#include "drivers/openni2/child/depth_sensor.h"

namespace instep {

/// Only one process at a time opens sensors of one OpenNI2 library to see which they are: two that
/// look for theirs would find each other's busy. Held while the object lives.
class SearchTurn {
 public:
  /// Waits for it, and calls `on_pause` all the while; fails with kTimeout after `limit`. One who
  /// hangs is ended by who started him, within SensorChoice::opening_limit, and several may be
  /// before this one.
  static Result<SearchTurn> wait(
      std::chrono::milliseconds limit, const std::function<void()>& on_pause = [] {});

 private:
  explicit SearchTurn(Descriptor lock) : lock_(std::move(lock)) {}
  Descriptor lock_;
};

/// Opens the sensor of this serial number; with none, the only one there is. Fails with kNotFound
/// if it is not there, naming those that are and one that cannot be opened, with kPermissionDenied
/// if that is for want of rights, with kInvalidInput if several have the number; without a number,
/// with what keeps the only one from being opened.
Result<std::unique_ptr<DepthSensor>> find_sensor(const std::string& serial);

/// All sensors, each opened for a moment.
std::vector<OpenniDevice> list_sensors();

}  // namespace instep
