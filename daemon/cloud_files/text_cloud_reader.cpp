#include "daemon/cloud_files/text_cloud_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::string_view kSeparators = " \t,;\v\f";
constexpr std::string_view kSeparatorsButCommas = " \t;\v\f";
constexpr std::size_t kMostColumns = 6;

/// The numbers of one line.
struct Row {
  std::array<double, kMostColumns> values{};
  std::size_t words = 0;
  bool all_numbers = true;
};

bool is_empty_or_comment(std::string_view line) {
  const auto start = line.find_first_not_of(" \t");
  return start == line.npos || line[start] == '#' || line.substr(start, 2) == "//";
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// Whether the commas are those of decimals: one in a word at most, between digits, something else
/// parts the words, and no number has a decimal point, beside which commas part thousands.
bool has_decimal_commas(std::string_view line) {
  if (line.find(',') == line.npos || line.find('.') != line.npos) return false;
  int words = 0;
  for (auto word = take_word(line, kSeparatorsButCommas); !word.empty();
       word = take_word(line, kSeparatorsButCommas)) {
    ++words;
    const auto comma = word.find(',');
    if (comma == word.npos) continue;
    const bool between_digits = comma > 0 && is_digit(word[comma - 1]) && comma + 1 < word.size() &&
                                is_digit(word[comma + 1]);
    if (!between_digits || word.find(',', comma + 1) != word.npos) return false;
  }
  return words > 1;
}

/// But for a semicolon that ends the line, as programs write the rows of a matrix.
bool has_commas_and_semicolons(std::string_view line) {
  const std::string_view row = line.substr(0, line.find_last_not_of(" \t;") + 1);
  return row.find(',') != row.npos && row.find(';') != row.npos;
}

Row parse_row(std::string_view line) {
  const bool decimal_commas = has_decimal_commas(line);
  const auto separators = decimal_commas ? kSeparatorsButCommas : kSeparators;
  Row row;
  for (std::string word(take_word(line, separators)); !word.empty();
       word = take_word(line, separators)) {
    if (decimal_commas) std::replace(word.begin(), word.end(), ',', '.');
    const auto value = number_in(word);
    row.all_numbers = row.all_numbers && value.has_value();
    if (value && row.words < kMostColumns) row.values[row.words] = *value;
    ++row.words;
  }
  return row;
}

bool is_point(const Row& row) {
  return row.all_numbers && (row.words == 3 || row.words == 6);
}

tl::unexpected<Error> bad_line(const std::string& file, std::size_t number,
                               const std::string& what) {
  return fail(ErrorCode::kCorruptData, fmt::format("line {} of {} {}", number, file, what),
              "give 3 or 6 numbers in each line, parted by blanks, commas or semicolons");
}

}  // namespace

Result<RawCloud> read_text_cloud(std::string_view text, const std::string& file) {
  RawCloud raw;
  raw.format = "text";
  TextLines lines(text);
  std::size_t number = 0;
  std::size_t columns = 0;
  bool heading_seen = false;
  std::optional<bool> decimal_commas;
  while (const auto line = lines.next()) {
    ++number;
    if (is_empty_or_comment(*line)) continue;
    const Row row = parse_row(*line);
    const bool may_be_heading = columns == 0 && !heading_seen;
    if (may_be_heading && (!row.all_numbers || row.words == 1)) {
      heading_seen = true;
      continue;
    }
    if (!is_point(row)) return bad_line(file, number, "is no point");
    if (line->find_first_of(",.") != line->npos) {
      const bool decimal = has_decimal_commas(*line);
      if (decimal_commas.value_or(decimal) != decimal) {
        return bad_line(file, number,
                        "has decimal commas and others none, or none and others have them");
      }
      decimal_commas = decimal;
      if (!decimal && has_commas_and_semicolons(*line)) {
        return bad_line(file, number, "has commas and semicolons, so the numbers cannot be told");
      }
    }
    if (columns == 0) columns = row.words;
    if (row.words != columns) {
      return bad_line(file, number,
                      fmt::format("has {} numbers, the first {}", row.words, columns));
    }
    if (raw.cloud.size() >= kMostFilePoints) {
      return fail(ErrorCode::kUnsupported,
                  fmt::format("{} has more than {} points", file, kMostFilePoints), "thin it out");
    }
    const auto& v = row.values;
    raw.cloud.positions.emplace_back(v[0], v[1], v[2]);
    if (columns == 6) raw.cloud.normals.emplace_back(v[3], v[4], v[5]);
  }
  return raw;
}

bool looks_like_text_cloud(std::string_view text) {
  TextLines lines(text);
  int looked_at = 0;
  while (const auto line = lines.next()) {
    if (is_empty_or_comment(*line)) continue;
    const Row row = parse_row(*line);
    if (row.all_numbers && row.words >= 3) return true;
    if (++looked_at >= 2) return false;
  }
  return false;
}

}  // namespace instep
