#pragma once

#include <array>
#include <string_view>

namespace instep {

/// The characters of Unicode that say in which direction text runs, in UTF-8: a single one turns
/// about all that stands behind it in its line, such as a date.
inline constexpr std::array<std::string_view, 12> kDirectionMarks = {
    "\u061C", "\u200E", "\u200F", "\u202A", "\u202B", "\u202C",
    "\u202D", "\u202E", "\u2066", "\u2067", "\u2068", "\u2069"};

/// Whether UTF-8 holds no control characters, none of kDirectionMarks and no breaks of lines.
bool is_printable(std::string_view text);

}  // namespace instep
