#pragma once

#include <string>
#include <vector>

#include "core/girth/section_line.h"

namespace instep {

/// Of the closed lines that a plane cuts out of a body (two toes, two feet), the one round the
/// largest area, turned counter-clockwise; the others are named in `warnings`. Open lines do not
/// count, and one at least is closed.
SectionLine choose_loop(std::vector<SectionLine> lines, std::vector<std::string>& warnings);

/// What a warning says of a loop that was not chosen.
std::string other_loop_warning(double length_mm);

}  // namespace instep
