#include "daemon/cloud_files/text_tokens.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace instep {

std::optional<std::string_view> TextLines::next() {
  if (rest_.empty()) return std::nullopt;
  const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (rest_.substr(0, 2) == "\r\n") {
    rest_.remove_prefix(2);
  } else if (!rest_.empty()) {
    rest_.remove_prefix(1);
  }
  return line;
}

std::string_view take_word(std::string_view& text, std::string_view separators) {
  text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
  const auto end = std::min(text.find_first_of(separators), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

std::size_t words_in_first_row(std::string_view text) {
  TextLines lines(text);
  std::size_t words = 0;
  for (auto line = lines.next(); line && words == 0; line = lines.next()) {
    while (!take_word(*line).empty()) ++words;
  }
  return words;
}

std::string_view without_blanks_at_end(std::string_view text) {
  const auto last = text.find_last_not_of(std::string_view(" \t\r\n\v\f\0", 7));
  return text.substr(0, last == text.npos ? 0 : last + 1);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return lower;
}

std::optional<double> number_in(std::string_view word) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too large for a double (damage, found later) or too small (nothing at a foot's scale).
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (error != std::errc{}) return std::nullopt;
  return value;
}

}  // namespace instep
