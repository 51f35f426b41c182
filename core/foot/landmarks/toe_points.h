#pragma once

#include <optional>

#include "core/foot/foot_scan.h"
#include "core/foot/skin/foot_outline.h"

namespace instep {

/// Right-foot form, as all here. Nothing where the cloud has no points there, or only the
/// rim of a hole (skin_round.h). `tibiale` and `fibulare` are the points of the ball.

/// The first toe takes so much of the ball's breadth, from medial.
inline constexpr double kFirstToeShare = 0.30;

/// The foremost point of the outline in the medial 0.30 of the ball's breadth.
std::optional<Landmark> find_toe1_tip(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare);

/// The highest point of the skin 15/260 of the foot's length behind the first toe's tip, in the
/// same strip.
std::optional<Landmark> find_toe1_top(const FootOutline& outline, const Landmark& tibiale,
                                      const Landmark& fibulare, const Landmark& tip);

/// Where a ruler laid against the ball's point touches the first toe: the outline's most medial
/// bearing from metatarsale tibiale in 0.80-0.95 of the foot's length.
std::optional<Landmark> find_toe1_contact(const FootOutline& outline, const Landmark& tibiale);

/// The same of the little toe, from metatarsale fibulare in 0.70-0.85.
std::optional<Landmark> find_toe5_contact(const FootOutline& outline, const Landmark& fibulare);

}  // namespace instep
