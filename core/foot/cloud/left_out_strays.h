#pragma once

#include "core/geometry/point_cloud.h"

namespace instep {

/// What was taken out of a cloud.
struct LeftOutStrays {
  double share = 0.0;      ///< of the points, clumps included
  bool any_clump = false;  ///< which may have been skin, seen apart from the rest
};

/// Takes strays (strays_among()) out of a cloud before anything is read off it: one under a foot
/// would be its floor, one before it its toe, and the skin of an open sole would be laid out to one
/// beside it. So it is with haze (haze_points()), as light makes that is scattered in glass under
/// the foot, and with clumps that no skin reaches (loose_clumps()), but in a cloud that stands in a
/// scanner's lines (scanner_lines()), whose last ones are as far from all others.
/// A thin line of strays that starts at the skin, and a larger or nearer clump, pass for skin.
///
/// Of more than 60,000 points just those that stand alone are strays; but where there are many
/// among some of them, all but as many others go with them, which show a foot no worse.
///
/// Nothing of a cloud to which points were added where nobody looked: it comes from cameras, whose
/// strays are left out where views are fused, and what was added stands as far apart as it was put.
LeftOutStrays leave_out_strays(PointCloud& cloud);

}  // namespace instep
