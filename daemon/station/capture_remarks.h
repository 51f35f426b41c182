#pragma once

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace instep {

/// What a result is to say of how its frames were taken. It is noted on the loop's thread while
/// another takes the frames: safe from any thread.
class CaptureRemarks {
 public:
  /// Counts once, however often it is noted.
  void note(const std::string& remark) {
    const std::lock_guard lock(mutex_);
    if (std::find(remarks_.begin(), remarks_.end(), remark) == remarks_.end()) {
      remarks_.push_back(remark);
    }
  }
  std::vector<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return remarks_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> remarks_;
};

}  // namespace instep
