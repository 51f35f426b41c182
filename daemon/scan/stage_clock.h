#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "daemon/scan/scan_pipeline.h"

namespace instep {

/// Follows a scan through its stages: times each, tells how far the scan is, and hears whether it
/// shall go on. Once it shall not, it stays so and nobody is asked any more.
class StageClock {
 public:
  explicit StageClock(const ScanProgress& progress) : progress_(progress) {}

  /// Ends the stage before and begins one. False: the scan is cancelled.
  bool begin(std::string_view stage, double done) {
    end();
    stage_ = stage;
    done_ = done;
    began_ = Clock::now();
    return go_on();
  }

  /// A piece of the stage is done. From any thread; `progress` hears of one at a time. False as
  /// above.
  bool go_on() {
    const std::lock_guard lock(asking_);
    wanted_ = wanted_ && (!progress_ || progress_(stage_, done_));
    return wanted_;
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
  std::mutex asking_;
  bool wanted_ = true;
  std::string stage_;
  double done_ = 0.0;
  Clock::time_point began_;
  std::map<std::string, double> timings_ms_;
};

}  // namespace instep
