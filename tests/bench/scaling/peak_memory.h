#pragma once

#include <cstddef>

namespace instep::bench {

/// How much memory this process takes at most from a moment on, by what Linux tells of it.
class PeakMemory {
 public:
  /// Gives back what is free and forgets earlier peaks.
  PeakMemory();

  /// The peak since then, over what was in use then; 0 where Linux does not tell.
  std::size_t bytes_more() const;

 private:
  std::size_t before_;
};

}  // namespace instep::bench
