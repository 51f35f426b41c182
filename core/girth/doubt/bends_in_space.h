#pragma once

#include "core/girth/contour/contour_course.h"
#include "core/girth/doubt/unseen_bends.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// Half-widths of 95 % intervals for what the lengths of a section may be where it bends sharply
/// between points of a thin part, of which a patch in space knows both sides: the tip may be as
/// round as that field draws it, or an edge. Where the contour turns by more than 36 degrees on so
/// short a way that points do not tell its course, what an edge that turns as far is longer than an
/// arc is the doubt. It adds up over the section, since a body has round tips or sharp ones.
///
/// `way`: that short, in the unit of the contour, as the half-widths; less than its length. Nothing
/// if it is not above 0. O(corners log corners), and as many looks for a patch as corners that
/// bend.
UnseenBends bends_in_space(const ContourCourse& course, const BlendedSurface& surface, double way);

}  // namespace instep
