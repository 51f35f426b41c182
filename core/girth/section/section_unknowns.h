#pragma once

#include <optional>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/contour/contour_zigzags.h"
#include "core/girth/doubt/unseen_bends.h"
#include "core/girth/section/finer_skin.h"
#include "core/girth/section/loops_beside.h"
#include "core/girth/section/narrow_parts.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/section_loops.h"
#include "core/girth/section/skin_layers.h"
#include "core/girth/section/smooth_section.h"
#include "core/girth/section/unfollowed_skin.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// What the fitted surface does not know of a section. All in the band's unit.
struct SectionUnknowns {
  UnseenBends bends;           ///< where there are no points
  UnseenBends between_lines;   ///< that points stand in
  UnseenBends in_space;        ///< at the tips of thin parts
  UnseenBends between_points;  ///< that are exact
  std::optional<SkinLayers> layers;
  double reach = 0.0;  ///< of either length, to layers or to what scatters in a part
  UnfollowedSkin skin;
  LoopsBeside beside;
  NarrowPart narrow;   ///< where no other skin is told of
  MissedLength finer;  ///< skin that the measured line does not follow
  /// The skin's, or made by strays beside it. They do not widen intervals here: which of the two it
  /// is a section without some points tells.
  Zigzags zigzags;
  double folds = 0.0;  ///< what folds that noise may have made add to the contact length
  double edge = 0.0;   ///< half of a 95 % interval by where the noisy cloud ends (doubt_of_edge())
  double rounding = 0.0;  ///< the same by coordinates with few digits (doubt_of_rounding())
};

/// `cloud`: that the band is of; `loops`: all that the plane cuts, the section first, for which
/// `evidence` is. `measured`: what is told, which may be another line. O(m log m) for the m points
/// of the band.
SectionUnknowns unknowns_of(const PlaneBand& band, const PointCloud& cloud,
                            const std::vector<SectionLoop>& loops, const BlendedSurface& surface,
                            const SectionEvidence& evidence, const MeasuredSection& measured);

/// Widens the intervals by them, and where noise was not what was told. Bends between points count
/// as much as all that was told before, at most.
void widen(const PlaneBand& band, const SectionUnknowns& unknowns, MeasuredSection& section);

}  // namespace instep
