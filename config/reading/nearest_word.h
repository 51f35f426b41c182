#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace instep {

/// The word of `known` that is fewest edits (insert, delete, replace, swap of neighbours) away from
/// `word`, if it is near enough to be a slip of the fingers (a third of its letters), or one that
/// it begins or that begins it; else empty.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace instep
