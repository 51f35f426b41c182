#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace instep {

/// Tells a hung thread from a busy one, for the watchdog: it is fed only if every busy thread has
/// taken a step since the last look. Pure.
class ProgressWatch {
 public:
  /// Enters what a thread is at. Call for every thread before each look.
  void note(const std::string& thread, bool busy, std::uint64_t progress) {
    auto& seen = threads_[thread];
    const bool moved = !seen.known || seen.progress != progress;
    seen = {true, progress, !busy || moved};
  }

  /// True if none hangs.
  bool all_moved() const {
    for (const auto& [name, seen] : threads_) {
      if (!seen.fine) return false;
    }
    return true;
  }

  /// The first that hangs; empty if none does.
  std::string hung() const {
    for (const auto& [name, seen] : threads_) {
      if (!seen.fine) return name;
    }
    return {};
  }

  /// The same, once for each time that it hangs: empty if that was told.
  std::string newly_hung() {
    std::string now = hung();
    if (now == told_) return {};
    told_ = now;
    return now;
  }

 private:
  struct Seen {
    bool known = false;
    std::uint64_t progress = 0;
    bool fine = true;
  };
  std::map<std::string, Seen> threads_;
  std::string told_;
};

}  // namespace instep
