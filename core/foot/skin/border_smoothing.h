#pragma once

namespace instep {

/// How far to either side of a place the samples of a foot's border have a say in it, in
/// millimetres on a foot of full size, where nothing asks for another: the noise of points asks for
/// more, and narrow bends, as those of toes, for less. For BorderProfile and SkinBorder.
inline constexpr double kBorderSmoothingMm = 9.0;

}  // namespace instep
