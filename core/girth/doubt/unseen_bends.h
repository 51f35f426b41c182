#pragma once

#include <numbers>
#include <vector>

#include "core/girth/contour/contour_course.h"

namespace instep {

/// By as much (radians) smooth bodies turn as well, out of sight or between points.
inline constexpr double kOrdinaryTurn = 0.2 * std::numbers::pi;
/// A corner that turns more (radians) is no better told by its ends' directions.
inline constexpr double kSharpestCorner = 0.6 * std::numbers::pi;

/// Half-widths of 95 % intervals for what the lengths of a section may be where it bends sharply
/// and no point shows it, as out of sight round the rim of a last or the edge of a sole; in the
/// unit of the contour.
struct UnseenBends {
  double contact_u95 = 0.0;
  double stretched_u95 = 0.0;  ///< a tape bridges inward bends, seen or not
};

/// A stretch without points may be an arc, as the surface bridges it, or as long as the corner in
/// which its ends' directions meet. That difference counts, and a fifth more since the surface
/// draws these directions inwards, as far as it is more than that of a turn by 36 degrees, which
/// smooth bodies make too. A stretch longer than half a circle over its ends is a spur that the
/// surface made up: it may all be too long. Several stretches add up as independent ones.
///
/// `ways`: along the course, as ContourIndex counts it too, to each place where a point
/// lies, in order; also of points that stand for skin that nobody saw. Of each stretch only what is
/// longer than `near` counts. Nothing without ways. O(corners + ways log corners).
///
/// Too little where noise has rounded the ends of a stretch already, or where it bends one way and
/// back.
UnseenBends unseen_bends_of(const ContourCourse& course, const std::vector<double>& ways,
                            double near);

/// By how much a stretch that turns by `turn` may be longer if it is a corner in place of an arc,
/// against its length and beyond what one with an `ordinary` turn may be; both in radians, above 0.
/// As if it turned by `sharpest` at most, less than half a turn: beyond it a corner's length grows
/// without bounds.
double longer_by_corner(double turn, double ordinary, double sharpest);

}  // namespace instep
