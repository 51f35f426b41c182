#pragma once

#include <optional>

#include "core/geometry/point_cloud.h"
#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// The girth of a section that is open on one side, as of a foot whose sole no camera saw: along
/// the skin that was seen, as the surface through its points runs, and straight across the opening,
/// as a tape lies over a flat sole. Nothing tells what lies there: the interval reaches to twice
/// what an arc adds that leaves the skin at both ends in its direction, and to any point near the
/// plane. So it holds of a flat side and of a round one; where the body has an edge in the opening
/// or tapers to a tip, it may be longer still. A warning says all that.
///
/// Nothing where the points leave no one opening, where no line along the skin leads from its one
/// end to the other or the skin turns away from it, where more than a tenth of the points near the
/// plane lie off that line, or where the interval of either length would be wider than 15 % of the
/// stretched one to each side: of a round body from a third of the way round on. Girth's
/// largest_gap_mm is the way between the ends of the skin. For a cloud that passed check_cloud();
/// costs as much as a girth.
std::optional<Girth> girth_over_opening(const PointCloud& cloud, const TapePlane& plane,
                                        const GirthOptions& options);

}  // namespace instep
