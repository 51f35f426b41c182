#pragma once

#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_index.h"

namespace instep {

/// Half of a 95 % interval of lengths by how noisy clouds are cut beside the plane: beyond their
/// edge points stand that noise moved out, and those that it moved in are missing within, or the
/// other way round, so that the skin ends too low or too high, and what is fitted to it passes that
/// on. The less the further the edge is from the plane. Nothing of exact points. O(log m) for each
/// of some thousands of the band's m points.
double doubt_of_edge(const PlaneBand& band, const ContourIndex& contour);

}  // namespace instep
