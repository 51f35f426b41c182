#pragma once

namespace instep {

/// The length of a foot of full size: about that of the feet by which the rules were made.
///
/// Feet of all sizes are alike in shape, so that the rules which find points of anatomy look at
/// each foot as if it were so long: how wide a patch of skin is, how high an outline, how far
/// behind a tip a height is taken, all in millimetres there, are in proportion on a child's foot. A
/// definition in millimetres of the foot itself, such as the heel's breadth 40 mm in front of the
/// pternion, is not. A child's foot of so many points a square millimetre, with so much noise, is
/// told as much worse by this as its windows are smaller, and redraws (redrawn_landmarks.h) say so.
inline constexpr double kFullSizeMm = 260.0;

/// By what a foot of some length is multiplied to have full size.
constexpr double full_size_factor(double length_mm) {
  return kFullSizeMm / length_mm;
}

}  // namespace instep
