#pragma once

#include <string>
#include <vector>

#include "core/girth/plane_band.h"
#include "core/girth/section_evidence.h"
#include "core/girth/section_loops.h"
#include "core/girth/section_unknowns.h"
#include "core/girth/smooth_section.h"
#include "core/result.h"

namespace instep {

/// Half of a 95 % interval that is worth a warning, against the length.
inline constexpr double kNotableDoubt = 0.02;
/// A share of the points near the plane, off all loops, that is.
inline constexpr double kNotableUnexplained = 0.02;
/// What is said of them.
inline constexpr const char* kBesideWarning =
    "points beside the section lie on no skin that closes: strays, a second layer or another body";

/// What whoever reads the girth should know. `loops`: the section's first, at least one.
std::vector<std::string> warnings_of(const PlaneBand& band, const std::vector<SectionLoop>& loops,
                                     const SectionEvidence& evidence,
                                     const SectionUnknowns& unknowns,
                                     const MeasuredSection& section);

/// A stretch without a seen point that is worth a warning.
bool has_notable_gap(const PlaneBand& band, const SectionEvidence& evidence);

/// Instead of a girth that is too uncertain to be told.
tl::unexpected<Error> too_doubtful(const SectionUnknowns& unknowns, const MeasuredSection& section);

/// The same of points that tell no reason.
tl::unexpected<Error> too_few_or_noisy();

}  // namespace instep
