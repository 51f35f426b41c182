#pragma once

#include <utility>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour.h"
#include "core/girth/contour/contour_index.h"
#include "core/girth/section/section_evidence.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// A closed line that the skin is cut in.
struct SectionLoop {
  Contour contour;
  ContourIndex index;

  explicit SectionLoop(Contour traced) : contour(std::move(traced)), index(contour) {}
};

/// Every loop that starts near a point on the plane and round which the body lies inside, the one
/// round the largest area first; none where nothing closes. Loops that far fewer points make than
/// the best founded one, for their length, are left out: strays can lie so that a surface passes
/// through them. So is the worse founded one of two that run together, as where a surface takes a
/// way out to a wall and back. Lays the patches of the surface.
std::vector<SectionLoop> loops_on(const PlaneBand& band, BlendedSurface& surface);

/// The part of the points near the plane that lies on no loop. `of_first`: the evidence for the
/// first one within evidence_reach(), not without a point.
double unexplained_share(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                         const SectionEvidence& of_first);

/// Whether those points enclose more than the first loop does, and do not go round it: as of a
/// larger body beside it whose section does not close.
bool has_larger_beside(const PlaneBand& band, const std::vector<SectionLoop>& loops);

}  // namespace instep
