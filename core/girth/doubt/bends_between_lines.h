#pragma once

#include "core/girth/contour/contour_course.h"
#include "core/girth/doubt/unseen_bends.h"
#include "core/surface/patches/blended_surface.h"

namespace instep {

/// Half-widths of 95 % intervals for what the lengths of a section may be where it runs from line
/// to line of points, such as the columns of a lattice or the lines of a scanner. Along them points
/// lie close together and show a skin as smooth as it may be, so that patches trust it between the
/// lines as well; but there may be an edge. Where a stretch between two lines turns otherwise than
/// the like ones before and behind do, it is likely to be: what an edge that turns by the
/// difference is longer than an arc is the doubt, as far as it is more than that of 11 degrees. It
/// adds up over the section, since most bodies have several edges or none, up to a part of its
/// length. Nothing where points lie evenly all round, or where the surface has an edge already.
///
/// Lengths in the unit of the contour; `spacing`: of the points. O(corners log points), and as many
/// corners and points of a patch for each stretch that turns so.
UnseenBends bends_between_lines(const ContourCourse& course, const BlendedSurface& surface,
                                double spacing);

}  // namespace instep
