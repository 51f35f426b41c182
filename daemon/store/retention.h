#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace instep {

/// How long results are kept; 0 = no limit.
struct Retention {
  int keep_days = 0;
  int keep_count = 0;  ///< the feet of one scan go together: it may be one more
};

/// Results that time is up for.
struct Expired {
  std::vector<std::string> ids;  ///< newest first
  /// How many were made later than `now`, by a clock that was wrong, or is. They are not touched,
  /// and not counted: else they would take the place of all that are scanned from now on.
  std::size_t made_later = 0;
};

/// `ids`: of all results, newest first.
Expired expired(const std::vector<std::string>& ids, const Retention& retention,
                std::chrono::system_clock::time_point now);

/// Whether an id was made later than `now`, by more than clocks that are set right differ.
bool is_made_later(const std::string& id, std::chrono::system_clock::time_point now);

}  // namespace instep
