#pragma once

#include <string>
#include <string_view>

namespace instep {

/// Text from outside, as a file's name, as a page can show it: bytes that are no UTF-8, the two
/// characters that Unicode has not, U+FFFE and U+FFFF, and those that turn a line about are
/// replaced by U+FFFD.
std::string mended_text(std::string_view text);

}  // namespace instep
