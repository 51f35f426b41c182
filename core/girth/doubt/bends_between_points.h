#pragma once

#include "core/girth/contour/contour_course.h"
#include "core/girth/doubt/unseen_bends.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// Half-widths of 95 % intervals for what the lengths of a section may be where it bends within the
/// spacing of exact points, such as at the edge of a scanned foot's sole: the surface is round
/// there, the skin may be a corner. That the skin is smooth shows where a point is left out and the
/// others tell where it lies: so each bend counts by the square of how far they miss it, against
/// what they would miss at a corner; a told slope there stays. Bends add up, since most bodies have
/// several edges or none. Of patches that have an edge, a polynomial or noise nothing counts.
///
/// Lengths in the unit of the contour; `spacing`: of the points. O(corners log corners), and
/// O(samples^3) for each patch that leads where the contour bends.
UnseenBends bends_between_points(const ContourCourse& course, const BlendedSurface& surface,
                                 double spacing);

}  // namespace instep
