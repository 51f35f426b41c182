#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/result.h"

namespace instep {

/// What OpenNI2 reports of one sensor, from threads of its own, until somebody asks. To be made
/// before the sensor is opened, so that nothing is missed.
class SensorEvents {
 public:
  explicit SensorEvents(const std::string& uri);
  ~SensorEvents();

  /// kDeviceGone once it was unplugged, kIo while it says that something is wrong with it.
  Result<void> look() const;

  /// The same where the sensor has just failed: that may come before the word that it was
  /// unplugged, which is waited for, up to 0.2 s.
  Result<void> look_after_failure() const;

 private:
  struct Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace instep
