#pragma once

#include <cstdint>

#include "tests/bench/accuracy/case_csv.h"

namespace instep::bench {

/// Measures so many cases of all kinds and prints how often their 95 % intervals hold, over all and
/// by every feature that the cases differ in. Tells how far it has come on standard error.
void report_drawn(std::uint64_t cases, bool verbose, CaseCsv& csv);

}  // namespace instep::bench
