#pragma once

#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {

/// Right-foot form, as all here. Nothing where the cloud has no points there, or, but for the
/// junction, only the rim of a hole (skin_round.h); of the heel's sides neither where no camera saw
/// their wall, and beside what was seen of it with Landmark::deviations_off_mm.

/// Where along the axis the heel's breadth is taken. Nothing if no breadth is found at all.
std::optional<double> heel_breadth_place(const FootOutline& outline, HeelBreadthRule rule);

/// The outline's sides there: by HeelBreadthRule::kSixth the heel's medial and lateral point.
std::optional<Landmark> find_heel_medial(const FootOutline& outline, HeelBreadthRule rule);
std::optional<Landmark> find_heel_lateral(const FootOutline& outline, HeelBreadthRule rule);

/// A foot's heel stands on the floor, that of a shoe last over it, as on the heel of a shoe.
enum class HeelStance { kOnFloor, kRaised };

/// Where a tape comes round the heel: the point of the heel's side view furthest from the instep
/// point, within a tenth of the foot's length of the line that falls from there by 26 degrees. By
/// furthest_of_standing_heel() or, of a raised heel, furthest_reach(). The distance is stationary
/// there, the girths are not: of drawn feet (tests/bench/feet) the short heel girth comes out 0.8
/// mm shorter for each millimetre, square to its tape, that the place is too high.
std::optional<Landmark> find_heel_point(const FootOutline& outline, const Landmark& instep,
                                        HeelStance stance);

/// Where the leg rises from the foot's back: the point of the back's side view nearest to the heel
/// point, between rays that rise by 23 and 49 degrees. Nothing where the leg is cut below it.
std::optional<Landmark> find_junction(const FootOutline& outline, const Landmark& heel);

}  // namespace instep
