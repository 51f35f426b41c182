#pragma once

#include <vector>

#include "core/girth/band/plane_band.h"

namespace instep {

/// The points of a band thinned to its grain: those within half a grain of each other averaged,
/// unless they face apart, weighed by their certainty. A mesh needs it, where noise would fold its
/// triangles; a fitted surface averages by itself.
struct CrowdAverage {
  std::vector<OrientedPoint> points;
  std::vector<bool> seen;  ///< whether any member of an averaged point was seen
};

CrowdAverage average_crowds(const PlaneBand& band);

}  // namespace instep
