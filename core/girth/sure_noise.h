#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/plane_band.h"

namespace instep {

/// Whether little noise that the points of a band of this cloud show is surely none of shape:
/// points that lie close together scatter as much (is_noise_between_pairs()), or so much comes from
/// rounding their coordinates, as in a file with few digits. It is not asked of noise so little
/// that it matters nowhere, or so much that no shape is taken for it; false of both. O(points of
/// the band).
bool shows_sure_noise(const PlaneBand& band, const PointCloud& cloud);

}  // namespace instep
