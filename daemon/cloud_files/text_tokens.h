#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace instep {

/// Walks through text line by line; "\n", "\r\n" and "\r" end a line.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  /// The next line without its end, or nothing at the end of the text.
  std::optional<std::string_view> next();

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// Takes the next word off the front of `text`; words are parted by any of `separators`. Empty at
/// the end.
std::string_view take_word(std::string_view& text, std::string_view separators = " \t\r\n\v\f");

/// Of the first line that has any; 0 if none has.
std::size_t words_in_first_row(std::string_view text);

/// Spaces, tabs, ends of lines and bytes of zero.
std::string_view without_blanks_at_end(std::string_view text);

/// Of A to Z; independent of the locale.
std::string lower_case(std::string_view text);

/// The number that the whole word is, or nothing. Independent of the locale; knows "nan" and "inf".
std::optional<double> number_in(std::string_view word);

}  // namespace instep
