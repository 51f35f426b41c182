#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace instep {

/// The numbers in a line (counted from 1) of a TOML text that 64 bits cannot hold, as they are
/// written. A 0 takes the place of each, so that what else is wrong with the text can be told: the
/// parser gives up at such a number.
std::vector<std::string> take_out_huge_numbers(std::string& text, unsigned line);

}  // namespace instep
