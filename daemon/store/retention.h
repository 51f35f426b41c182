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
  std::vector<std::string> ids;
  /// How many were made later than `now`, by a clock that was wrong, or is. They are not touched,
  /// and not counted: else they would take the place of all that are scanned from now on.
  std::size_t made_later = 0;
  /// How many are dated before there was this program, by a clock that did not know the time.
  /// Nothing tells how old they are: they are not touched and not counted once the clock is right,
  /// and never too old.
  std::size_t made_before_all = 0;
};

/// `ids`: of all results, newest first. `last_stored`: of the scan that was stored last, which is
/// the newest whatever its date; empty if that is not known.
Expired expired(std::vector<std::string> ids, const Retention& retention,
                std::chrono::system_clock::time_point now, const std::string& last_stored);

/// Whether an id was made later than `now`, by more than clocks that are set right differ.
bool is_made_later(const std::string& id, std::chrono::system_clock::time_point now);

}  // namespace instep
