#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_band.h"

namespace instep {

/// Whether little noise of the points of a band of this cloud is surely none of shape: it was told
/// and is believed, points that lie close together scatter as much (is_noise_between_pairs()), or
/// so much comes from rounding their coordinates, as in a file with few digits. Of a cloud that was
/// turned since, as a foot is into its own frame, rounding tells nothing, and close pairs alone do.
/// It is not asked of untold noise so little that it matters nowhere, or so much that no shape is
/// taken for it; false of both. O(n log n) for the points of the band.
bool is_surely_noise(const PlaneBand& band, const PointCloud& cloud, bool is_told);

}  // namespace instep
