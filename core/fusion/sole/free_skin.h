#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The side view of skin that hangs free between where it was last seen and where it comes to rest
/// on the platform: its bend falls to none at the contact, as the power `falloff` of the way that
/// is left. With 0 it is an arc, as taut skin is over flesh under an even pressure; with 1 it bends
/// most where it was last seen and settles gently; with more it comes down in a long slope.
///
/// `turn`: angle, in radians above 0 and at most pi/2, between the skin's direction where it begins
/// and the platform; `height` of that place. Corners as inward distance (from 0 on) and height
/// (down to 0).
std::vector<Eigen::Vector2d> free_skin(double turn, double falloff, double height);

/// The falloff, 0 to 8, of the skin that begins with a bend (curvature times height). A skin that
/// was seen to bend less than an arc would must bend more below, and has 0; one that was seen to
/// bend more than one of 8 does has 8 (to within 0.04), and begins with a lesser bend than its own.
double falloff_of_bend(double turn, double bend_of_height);

}  // namespace instep
