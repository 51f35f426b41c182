#pragma once

namespace instep {

/// Terms of a polynomial that the points determine less than this, against the one that they
/// determine best, are told by none: on a flat patch nothing tells the square of the height.
inline constexpr double kLeastDetermined = 1e-3;

/// Least smoothing, against a unit kernel: keeps a system solvable where points nearly coincide.
inline constexpr double kLeastSmoothing = 1e-10;

}  // namespace instep
