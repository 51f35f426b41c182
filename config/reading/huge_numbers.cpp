#include "config/reading/huge_numbers.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace instep {
namespace {

bool is_of_a_number(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
         std::string_view("+-._").find(letter) != std::string_view::npos;
}

/// The byte at a place; the text's end if there is no such place.
std::size_t byte_at(const std::string& text, TomlPlace place) {
  std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // a byte order mark is no character
  for (unsigned line = 1; line < place.line && at < text.size(); ++line) {
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  for (unsigned column = 1; column < place.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) ++at;
  }
  return at;
}

bool is_whole(const std::string& number) {
  const std::size_t prefix = number.find_first_of("xob");
  return prefix != std::string::npos || number.find_first_of(".eE") == std::string::npos;
}

/// The parser has checked the form of a number before it says any of these.
bool tells_of_a_huge_number(const std::string& fault) {
  return fault.find("is not representable in 64 bits") != std::string::npos ||
         (fault.find("floating-point") != std::string::npos &&
          fault.find("could not be interpreted as a value") != std::string::npos);
}

/// Longer than the parser looks, which stays at its begin.
bool tells_of_an_endless_number(const std::string& fault) {
  return fault.find("numeric value too long") != std::string::npos;
}

}  // namespace

std::optional<std::string> take_out_huge_number(std::string& text, TomlPlace place,
                                                const std::string& fault) {
  const bool is_endless = tells_of_an_endless_number(fault);
  if (!is_endless && !tells_of_a_huge_number(fault)) return std::nullopt;
  // The parser stands behind the number when it gives up.
  std::size_t begin = byte_at(text, place);
  std::size_t end = begin;
  while (is_endless && end < text.size() && is_of_a_number(text[end])) ++end;
  while (!is_endless && begin > 0 && is_of_a_number(text[begin - 1])) --begin;
  if (begin == end) return std::nullopt;
  const std::string number = text.substr(begin, end - begin);
  text.replace(begin, end - begin, 1, '0');
  return number;
}

std::string limits_of(const std::string& number) {
  return is_whole(number) ? "whole numbers go from -9223372036854775808 to 9223372036854775807"
                          : "numbers go from -1.7976931348623157e308 to 1.7976931348623157e308";
}

}  // namespace instep
