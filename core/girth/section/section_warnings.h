#pragma once

#include <string>
#include <vector>

#include "core/girth/band/plane_band.h"
#include "core/girth/section/section_evidence.h"
#include "core/girth/section/section_loops.h"
#include "core/girth/section/section_unknowns.h"
#include "core/girth/section/smooth_section.h"
#include "core/result.h"

namespace instep {

/// Half of a 95 % interval, against the length, with which a girth is uncertain.
inline constexpr double kNotableDoubt = 0.02;
/// The share of the points near the plane on no loop with which there is more than the body.
inline constexpr double kNotableUnexplained = 0.02;

/// What whoever reads the girth should know. `loops`: the section's first, at least one.
/// `unexplained`: the share of the points that lies on none (unexplained_share()).
std::vector<std::string> warnings_of(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                                     const SectionEvidence& evidence, double unexplained,
                                     const SectionUnknowns& unknowns,
                                     const MeasuredSection& section);

/// Instead of a girth that is too uncertain to be told.
tl::unexpected<Error> too_doubtful(const SectionUnknowns& unknowns, const MeasuredSection& section);

/// Instead of one of which the contact length is.
tl::unexpected<Error> too_folded(const SectionUnknowns& unknowns, const MeasuredSection& section);

/// Instead of one that turns to and fro, as without some points it does not.
tl::unexpected<Error> too_many_zigzags();

}  // namespace instep
