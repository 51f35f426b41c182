#pragma once

#include <algorithm>

namespace instep {

/// What two sheets have to show to be taken for a crease, and not for one sheet that bends.
struct CreaseRule {
  double least_turn;  ///< in radians
  double widest_gap;  ///< further from all points, in spacings, its place is a guess
  double least_gain;  ///< by which one smooth sheet misfits the points more
  double plain_turn;  ///< of those that turn less (radians) more is asked: they look like bends

  double gain_asked(double turn) const {
    constexpr double kMorePerRadian = 10.0;
    return least_gain * (1.0 + kMorePerRadian * std::max(0.0, plain_turn - turn));
  }
};

/// Told normals show smaller turns, and lead sheets further.
inline constexpr CreaseRule kToldCrease = {
    .least_turn = 0.4, .widest_gap = 3.0, .least_gain = 8.0, .plain_turn = 0.0};

/// Points that scatter little show which sheet they lie on, and lead sheets as far as told normals
/// do. Few of them may look like two sheets where the skin bends: girths of simulated feet of 1,080
/// points err 0.10 mm; with a gain of 15 for 25 0.16, with 8 whatever the turn 0.22.
inline constexpr CreaseRule kClearCrease = {
    .least_turn = 0.6, .widest_gap = 3.0, .least_gain = 25.0, .plain_turn = 1.0};

inline constexpr CreaseRule kNoisyCrease = {
    .least_turn = 0.9, .widest_gap = 1.4, .least_gain = 8.0, .plain_turn = 0.0};

/// What two sheets turn is told by planes, then by quadratics, and at last by the patches that the
/// rules above are for. Each is so much more work than the one before that it is done only where
/// that one turns so much (radians). Planes turn as sheets do that bend neither towards the crease
/// nor away from it, so no less is asked of them.
inline constexpr double kLeastTurnOfPlanes = kClearCrease.least_turn;
inline constexpr double kLeastTurnOfToldPlanes = kToldCrease.least_turn;
/// Nearly as the patches do, for which a little is left.
inline constexpr double kLeastTurnOfQuadratics = 0.55;

}  // namespace instep
