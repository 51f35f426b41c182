#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"

namespace instep {

/// The step, in millimetres, that the coordinates of a band's points are rounded to, as in a file
/// with few digits (coordinate_step()). Of a cloud that was turned since, as a foot is into its own
/// frame, nothing tells it: zero. O(n log n) for the points of the band.
double rounding_step_mm(const PlaneBand& band, const PointCloud& cloud);

/// Half of a 95 % interval, in the band's unit, by what such rounding does to a section round which
/// the way is `length`, in that unit too. Where the skin is about level with an axis, on both its
/// sides and for two axes, all points go to the same level, by half a step too far out or in;
/// elsewhere, and where the points' own noise is as wide as half a step, rounding is noise of each
/// point and counts as that. Zero of exact points, which lie on a lattice by nature, and of steps
/// under 0.2 mm, which do hardly anything, found quickly.
double doubt_of_rounding(const PlaneBand& band, const PointCloud& cloud, double length);

}  // namespace instep
