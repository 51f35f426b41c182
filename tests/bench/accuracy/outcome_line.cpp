#include "tests/bench/accuracy/outcome_line.h"

#include <fmt/core.h>

namespace instep::bench {

void print_outcome(const test::GirthCase& measured_case, const test::Outcome& outcome) {
  if (outcome.refusal) {
    fmt::print("    {} refused: {}\n", measured_case.name, *outcome.refusal);
    return;
  }
  fmt::print(
      "    {:<44} stretched {:+9.5f} contact {:+9.5f} u95 {:.5f} {:.5f} sigma {:.4f} band {} "
      "{:.1f} ms\n",
      measured_case.name, outcome.stretched_error_mm, outcome.contact_error_mm,
      outcome.stretched_u95_mm.value_or(-1.0), outcome.contact_u95_mm.value_or(-1.0),
      outcome.sigma_mm, outcome.band_points, outcome.milliseconds);
}

}  // namespace instep::bench
