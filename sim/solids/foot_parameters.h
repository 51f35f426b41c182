#pragma once

#include <cstdint>

#include "core/foot/side.h"
#include "core/result.h"

namespace instep {

/// The shape of a foot with its lower leg, as it stands. All lengths are nominal: the truth of a
/// measure comes from the finished solid (sim/truth.h), which keeps length_mm, ball_breadth_mm and
/// instep_height_mm within about 1 mm.
///
/// The range of a value is what draw_foot() draws from, and what check_foot_parameters() admits is
/// a little wider.
struct FootParameters {
  Side side = Side::kRight;
  double length_mm = 252.0;        ///< 200..310, heel to the longest toe
  double ball_breadth_mm = 98.0;   ///< 0.36..0.42 of the length, square to the foot
  double heel_breadth_mm = 63.0;   ///< 0.23..0.27 of the length
  double instep_height_mm = 64.0;  ///< 0.23..0.28 of the length, at half the length
  double arch_lift_mm = 0.0;       ///< -6..8: the medial arch above (below) the usual one
  double second_toe_mm = -3.0;     ///< -8..5: how far the second toe reaches beyond the first
  double toe_separation = 0.5;     ///< 0 (one mitten) .. 1 (clefts between the toes)
  double hallux_angle_deg = 5.0;   ///< 0..14: the first toe turned towards the others
  double ankle_girth_mm = 225.0;   ///< 0.80..1.0 of the length, nominal, above the malleoli
  double lean_forward_deg = 2.0;   ///< -4..8: leg against the vertical
  double lean_medial_deg = 0.0;    ///< -4..4
  double leg_height_mm = 330.0;    ///< 300..360, where the calf is rounded off
  double rim_radius_mm = 6.0;      ///< 5..8, where the skin turns under the sole
};

/// A foot from the population the ranges describe. The same seed gives the same foot.
FootParameters draw_foot(std::uint64_t seed, Side side);

/// Fails with kInvalidInput on values that are not finite or for which no foot can be built.
Result<void> check_foot_parameters(const FootParameters& parameters);

}  // namespace instep
