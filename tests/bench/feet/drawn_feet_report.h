#pragma once

#include <cstddef>
#include <cstdint>

namespace instep::bench {

struct DrawnFeetWishes {
  std::size_t feet = 200;
  std::uint64_t first_seed = 1;
  std::size_t threads = 2;
  bool all_open = false;  ///< no sole is seen
  bool verbose = false;
};

/// Draws feet (tests/support/cases/drawn_feet.h), measures each, and prints a line a measure:
/// error, share within its bar, share of 95 % intervals that hold.
void report_drawn_feet(const DrawnFeetWishes& wishes);

}  // namespace instep::bench
