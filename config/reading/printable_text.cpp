#include "config/reading/printable_text.h"

#include <algorithm>
#include <cstddef>

namespace instep {
namespace {

/// U+0080 to U+009F, some of which tell a terminal what to do.
bool has_high_controls(std::string_view text) {
  for (std::size_t at = text.find('\xC2'); at != std::string_view::npos;
       at = text.find('\xC2', at + 1)) {
    if (at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xA0) return true;
  }
  return false;
}

}  // namespace

bool is_printable(std::string_view text) {
  const auto is_control = [](char letter) {
    return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
  };
  const auto is_in_it = [&](std::string_view mark) {
    return text.find(mark) != std::string_view::npos;
  };
  return std::none_of(text.begin(), text.end(), is_control) && !has_high_controls(text) &&
         std::none_of(kDirectionMarks.begin(), kDirectionMarks.end(), is_in_it) &&
         !is_in_it("\u2028") && !is_in_it("\u2029");
}

}  // namespace instep
