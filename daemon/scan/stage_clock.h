#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "daemon/scan/scan_pipeline.h"

namespace instep {

/// Follows a scan through its stages: times each, tells how far the scan is, and hears whether it
/// shall go on.
class StageClock {
 public:
  explicit StageClock(const ScanProgress& progress) : progress_(progress) {}

  /// Ends the stage before and begins one. False: the scan is cancelled.
  bool begin(std::string_view stage, double done) {
    end();
    stage_ = stage;
    began_ = Clock::now();
    return progress_ ? progress_(stage, done) : true;
  }

  void end() {
    if (!stage_.empty()) timings_ms_[stage_] += elapsed_ms();
    stage_.clear();
  }

  /// Stage -> milliseconds, of the stages that have ended.
  const std::map<std::string, double>& timings_ms() const { return timings_ms_; }

 private:
  using Clock = std::chrono::steady_clock;

  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - began_).count();
  }

  const ScanProgress& progress_;
  std::string stage_;
  Clock::time_point began_;
  std::map<std::string, double> timings_ms_;
};

}  // namespace instep
