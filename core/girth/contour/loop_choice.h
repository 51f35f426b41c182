#pragma once

#include <string>
#include <vector>

#include "core/girth/contour/section_line.h"
#include "core/girth/tape_plane.h"

namespace instep {

/// Of the closed lines that a tape plane cuts out of bodies (two toes, two feet), the one that goes
/// by all three control points, or if none or several do, the one round the largest area. Turned
/// counter-clockwise; the others are named in `warnings`. Open lines do not count, and one at least
/// is closed.
SectionLine choose_loop(std::vector<SectionLine> lines, const TapePlane& plane,
                        std::vector<std::string>& warnings);

/// What a warning says of a loop that was not chosen.
std::string other_loop_warning(double length_mm);

}  // namespace instep
