#pragma once

#include "tests/support/cases/outcome.h"

namespace instep::bench {

/// Prints a case by itself, for a look at the single ones.
void print_outcome(const test::GirthCase& measured_case, const test::Outcome& outcome);

}  // namespace instep::bench
