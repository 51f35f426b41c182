#pragma once

#include <cstddef>
#include <vector>

#include "core/fusion/views/thin.h"
#include "core/fusion/views/witness.h"

namespace instep {

/// The points, as ascending indices, that no other view contradicts. A point that one sees through
/// (Witness::judge() with `margin_mm`) and none confirms floats in the air: a remnant of a
/// silhouette. ViewedCloud::views index `views`. Some 0.1 us a point and view.
std::vector<std::size_t> points_not_seen_through(const ViewedCloud& points,
                                                 const std::vector<PosedDepth>& views,
                                                 double margin_mm);

}  // namespace instep
