#pragma once

#include "core/girth/contour/contour.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// What is not seen of the lengths of a contour on the plane z = 0, read off a fitted surface; in
/// the unit of the surface.
///
/// To first order a length changes by what each corner moves outwards times what the line turns
/// there (ContourTurns). Each height of a patch is a sum over the heights of points, so their
/// noise goes through to the length (HeightPatch::sums()); for a corner the patch that counts most
/// there stands for the blend. The same sums tell how far the surface may wander between the points
/// (kriging), holes and the reach beyond the last points of a crease included.
///
/// To second order waves lengthen a line: by those that noise put into the contour it is too long,
/// by those that the true one has between the points it is too short. Both are expected from the
/// same sums, the latter where the points show that the surface bends at their own scale
/// (HeightPatch::fine_bending()), and more of them round a body than along it. Under noise uneven
/// skin has more than they tell, which shows in narrow, rough patches. What waves make together is
/// to be added, within limits; neither is known to be there, so both count as doubt too.
///
/// The parts are weighed so that over thousands of drawn shapes, feet and lasts of any density,
/// noise and sampling about 95 % of the intervals hold (tests/bench/accuracy).
struct LengthDoubt {
  double waves = 0.0;        ///< to be added to both lengths
  double contact_u95 = 0.0;  ///< half-widths of 95 % intervals
  double stretched_u95 = 0.0;
};

/// `contour` as traced on `surface`, whose points are `sigma` off as a rule. O(patches x
/// samples^3).
LengthDoubt doubt_of(const Contour& contour, const BlendedSurface& surface, double sigma);

/// Half of a 95 % interval of a contour's length by not knowing in which direction its points are
/// `sigma` off. Along the normals of a round body they lie, as heights over a plane, lower than
/// they should, by their variance times its bend; along a camera's rays they do not. Of 314,000
/// points with 1 mm of noise along normals, round 251 mm, girths by patches are 0.15 mm short; of
/// an ellipse of 50 and 20 mm 0.37.
double doubt_of_direction(double sigma, const Contour& contour);

}  // namespace instep
