#pragma once

#include <cstddef>
#include <vector>

#include "tests/support/cases/case_bodies.h"

namespace instep::test {

/// So many feet of the simulated station's population, up to 100 mm above the floor, with planes
/// from the ball to the instep; the lengths are those of the solids themselves.
std::vector<CaseBody> simulated_feet(std::size_t count);

}  // namespace instep::test
