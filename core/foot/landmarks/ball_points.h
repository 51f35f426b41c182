#pragma once

#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {

/// The head of the first metatarsal: the most medial point of the ball. Right-foot form. Nothing
/// where the outline has no points there, or only the rim of a hole (skin_round.h). Where a border
/// was not seen, or points were put for it, for 8 mm or more near the point or between it and its
/// usual place, as between two feet, both points of the ball are told by what was seen beside them
/// and by what is usual of feet (core/foot/skin/hidden_crest.h), and carry
/// Landmark::deviations_off_mm.
std::optional<Landmark> find_metatarsale_tibiale(const FootOutline& outline);

/// The head of the fifth metatarsal: the most lateral point of the ball, behind `tibiale`.
/// Right-foot form.
std::optional<Landmark> find_metatarsale_fibulare(const FootOutline& outline,
                                                  const Landmark& tibiale);

/// The most medial and the most lateral point of the outline in 0.50-0.85 of the foot's length:
/// the ends of its horizontal breadth. Nothing as above. Where
/// `tibiale` or `fibulare` are told for a border that was not seen, no less far out than these, and
/// with deviations of their own.
std::optional<Landmark> find_ball_medial(const FootOutline& outline, const Landmark& tibiale);
std::optional<Landmark> find_ball_lateral(const FootOutline& outline, const Landmark& fibulare);

/// The highest point of the upright section through the two points of the ball. Where these may be
/// off, one of Landmark::deviations_off_mm holds what its height moves by.
std::optional<Landmark> find_ball_top(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare);

}  // namespace instep
