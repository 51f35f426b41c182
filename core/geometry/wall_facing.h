#pragma once

namespace instep {

/// z of the unit normal of a foot's wall, at most; skin that faces up more is of the foot's back.
inline constexpr double kMostUpwardOfWall = 0.5;

}  // namespace instep
