#pragma once

#include <cstddef>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_index.h"

namespace instep {

/// What the points near the tape plane say of a contour on it. Lengths in the band's unit.
struct SectionEvidence {
  std::size_t along = 0;   ///< points near the contour and the plane
  std::size_t beside = 0;  ///< points as near to the plane, but on no skin that runs to it
  /// Along the contour to each of those that lies so near to it in space that the skin there is no
  /// guess, in order.
  std::vector<double> ways;
  double gap = 0.0;       ///< longest stretch of the contour without one of these
  double seen_gap = 0.0;  ///< longest stretch without one that a camera saw
};

/// Points further from the contour or the plane than this are no evidence for it. In the unit.
double evidence_reach(const PlaneBand& band);

/// Points within `near` of the plane and of the contour count. O(points of the band).
SectionEvidence evidence_for(const PlaneBand& band, const ContourIndex& contour, double near);

/// Whether a point may be of the skin that is cut in the contour: within `near` of it, or further
/// by as much as skin that faces as the point does runs aside on its way to the plane.
bool may_run_to(const ContourIndex& contour, const OrientedPoint& point, double near);

/// Whether there is a stretch without a seen point that is worth a warning.
bool has_notable_gap(const PlaneBand& band, const SectionEvidence& evidence);

}  // namespace instep
