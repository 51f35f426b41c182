#pragma once

#include "core/geometry/point_cloud.h"
#include "core/geometry/scan_lines.h"
#include "core/girth/plane_slab.h"

namespace instep {

/// Of points on lines that are far apart, as few on each as the lines beside it can be seen with:
/// of more, patches of the nearest points would see no other line. Exact points are picked, those
/// of noisy lines averaged along theirs, each over a stretch of its own, so that nothing that they
/// tell is lost. `slab` in its order, and of the cloud; `lines` in its unit. Points that stand
/// alone stay as they are. O(m (log m + points within half a gap)) for its m points.
PlaneSlab thinned_lines(const PointCloud& cloud, const PlaneSlab& slab, const ScanLines& lines);

}  // namespace instep
