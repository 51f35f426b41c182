#pragma once

#include "core/geometry/point_cloud.h"
#include "core/girth/band/plane_slab.h"

namespace instep {

/// What thinned_lines() leaves of a slab.
struct ThinnedLines {
  PlaneSlab slab;
  double stray_share = 0.0;  ///< of the points: strays, left out
};

/// Of points on lines that are far apart, as few on each as the lines beside it can be seen with:
/// of more, patches of the nearest points would see no other line. Exact points are picked, those
/// of noisy lines averaged along theirs, each over a stretch of its own: four fifths of what they
/// tell are kept. Points that stand alone stay as they are. Strays, beside a line or alone amid
/// lines, are left out, unless the lines are thick with noise.
///
/// Within half a gap of a point on a line all have to be of that line: the middle of another sheet
/// or of points all round would be taken.
///
/// `slab` in its order, and of the cloud; `apart` > 0: from line to line, in
/// its unit. `weighed`: by what the cloud tells
/// of the noise of each, if it does. O(m (log m + points within half a gap)) for its m points.
ThinnedLines thinned_lines(const PointCloud& cloud, const PlaneSlab& slab, double apart,
                           bool weighed);

}  // namespace instep
