#pragma once

#include <cstddef>
#include <optional>

#include "tests/support/cases/case_bodies.h"

namespace instep::test {

/// Standard deviation of the stretched girth that a fit by a parabola along the body has under
/// white noise, if it uses all of an analytic body's points and resolves all of its section:
///
///     sigma * 1.5 * sqrt(K / (2 rho w))
///
/// with K the integral of the tape's squared curvature, rho the points on a square millimetre
/// and w half the length of the body. Nothing without noise.
std::optional<double> noise_floor(const TrueLengths& lengths, std::size_t points, double sigma_mm);

}  // namespace instep::test
