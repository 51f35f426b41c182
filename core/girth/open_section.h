#pragma once

#include <optional>

#include "core/geometry/point_cloud.h"
#include "core/girth/girth.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// The girth of a section that is open on one side, as of a foot whose sole no camera saw: along
/// the skin that was seen, as the surface through its points runs, and straight across the opening,
/// as a tape lies over a flat sole. Nothing tells what lies there: the interval reaches to an arc
/// that leaves the skin at both ends in its direction, and a fifth further. A section of a round
/// body holds so, and one with a flat side; a corner that nobody saw is longer still. A warning
/// says all that.
///
/// Nothing where the points leave no one opening, where no line along the skin leads from its one
/// end to the other, where more than a tenth of the points near the plane lie off that line, or
/// where what may lie in the opening is too much to tell anything (is_too_doubtful()): an arc over
/// two fifths of a circle is. For a cloud that passed check_cloud(); costs as much as a girth.
std::optional<Girth> girth_over_opening(const PointCloud& cloud, const TapePlane& plane,
                                        const GirthOptions& options);

}  // namespace instep
