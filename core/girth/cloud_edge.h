#pragma once

#include "core/girth/contour_index.h"
#include "core/girth/plane_band.h"

namespace instep {

/// How much of a contour runs along the edge of its cloud: beside it, within `near` of the plane,
/// points lie on one side of the plane alone. What is missing on either side counts; at most the
/// contour's length. O(m log m) for the m points of the band.
double length_at_edge(const PlaneBand& band, const ContourIndex& contour, double near);

/// Half of a 95 % interval of lengths by how noisy clouds are cut: beyond their edge points stand
/// that noise moved out, and those that it moved in are missing within, or the other way round, so
/// that the skin ends too low or too high. Nothing of exact points. As costly.
double doubt_of_edge(const PlaneBand& band, const ContourIndex& contour, double near);

}  // namespace instep
