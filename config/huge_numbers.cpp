#include "config/huge_numbers.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

namespace instep {
namespace {

/// The line's place in the text, without its end; empty at the text's end if there is no such line.
std::pair<std::size_t, std::size_t> place_of(const std::string& text, unsigned line) {
  std::size_t begin = 0;
  for (unsigned before = 1; before < line && begin != std::string::npos; ++before) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  begin = std::min(begin, text.size());
  return {begin, std::min(text.find('\n', begin), text.size())};
}

template <typename Number>
bool overflows(const std::string& digits) {
  Number number{};
  return std::from_chars(digits.data(), digits.data() + digits.size(), number).ec ==
         std::errc::result_out_of_range;
}

/// Of a number as TOML writes it, from its first digit on.
bool is_huge(std::string number) {
  number.erase(std::remove(number.begin(), number.end(), '_'), number.end());
  const bool is_whole = number.find_first_of(".eE") == std::string::npos;
  return is_whole ? overflows<std::int64_t>(number) : overflows<double>(number);
}

std::size_t end_of_number(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size()) {
    const bool sign = text[end] == '+' || text[end] == '-';
    const bool in_exponent = end > begin && (text[end - 1] == 'e' || text[end - 1] == 'E');
    if (sign ? !in_exponent
             : std::string_view("0123456789_.eE").find(text[end]) == std::string::npos)
      break;
    ++end;
  }
  return end;
}

}  // namespace

std::vector<std::string> take_out_huge_numbers(std::string& text, unsigned line) {
  std::vector<std::string> huge;
  const auto [line_begin, line_end] = place_of(text, line);
  const std::string before = text.substr(line_begin, line_end - line_begin);
  std::string after;
  for (std::size_t at = 0; at < before.size();) {
    if (before[at] < '0' || before[at] > '9') {
      after += before[at++];
      continue;
    }
    const std::size_t end = end_of_number(before, at);
    const std::string number = before.substr(at, end - at);
    if (is_huge(number)) huge.push_back(number);
    after += is_huge(number) ? "0" : number;
    at = end;
  }
  text.replace(line_begin, line_end - line_begin, after);
  return huge;
}

}  // namespace instep
