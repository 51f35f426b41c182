#include "daemon/cloud_files/text_cloud_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>

#include "daemon/cloud_files/error_properties.h"
#include "daemon/cloud_files/text_columns.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::string_view kSeparators = " \t,;\v\f";
constexpr std::string_view kSeparatorsButCommas = " \t;\v\f";
constexpr std::string_view kQuotes = "\"'";
constexpr std::size_t kMostColumns = 64;
constexpr int kMostLinesBefore = 3;  ///< without numbers, before the first point
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The numbers of one line.
struct Row {
  std::array<double, kMostColumns> values{};
  std::size_t words = 0;
  bool all_numbers = true;
  bool any_number = false;
  std::string first_word_of_letters;  ///< that is no number; empty if all are
};

bool is_empty_or_comment(std::string_view line) {
  const auto start = line.find_first_not_of(" \t");
  return start == line.npos || line[start] == '#' || line.substr(start, 2) == "//";
}

std::string_view without_comment_sign(std::string_view line) {
  return line.substr(std::min(line.size(), line.find_first_not_of(" \t#/")));
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
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

/// Some numbers are parted by blanks or semicolons alone and others by commas alone, which may part
/// thousands.
bool has_commas_within_words(std::string_view line) {
  int words = 0;
  bool within = false;
  for (auto word = take_word(line, kSeparatorsButCommas); !word.empty();
       word = take_word(line, kSeparatorsButCommas)) {
    ++words;
    const auto comma = word.find(',');
    within = within || (comma != word.npos && comma > 0 && comma + 1 < word.size());
  }
  return within && words > 1;
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
    if (!value && row.all_numbers) row.first_word_of_letters = word;
    row.all_numbers = row.all_numbers && value.has_value();
    row.any_number = row.any_number || value.has_value();
    if (value && row.words < kMostColumns) row.values[row.words] = *value;
    ++row.words;
  }
  return row;
}

/// As some programs write every cell of a table.
bool has_quoted_numbers(std::string_view line) {
  if (line.find_first_of(kQuotes) == line.npos) return false;
  std::string plain(line);
  std::erase_if(plain, [](char letter) { return kQuotes.find(letter) != kQuotes.npos; });
  const Row row = parse_row(plain);
  return row.all_numbers && row.words > 0;
}

tl::unexpected<Error> bad_line(const std::string& file, std::size_t number,
                               const std::string& what) {
  return fail(ErrorCode::kCorruptData, fmt::format("line {} of {} {}", number, file, what),
              "give numbers alone in each line, 3 to 64, parted by blanks, commas or semicolons; "
              "name those "
              "that count in a heading: x, y, z, nx, ny, nz, sigma_mm");
}

tl::unexpected<Error> no_point(const Row& row, const std::string& file, std::size_t number) {
  if (!row.any_number || row.words > kMostColumns) return bad_line(file, number, "is no point");
  constexpr std::size_t kLongest = 40;
  std::string word = row.first_word_of_letters.substr(0, kLongest);
  std::erase_if(word, [](char letter) { return kQuotes.find(letter) != kQuotes.npos; });
  return bad_line(file, number, fmt::format("holds \"{}\", which is no number", word));
}

/// Of columns that nobody named.
bool leave_some_out(const TextColumns& usual) {
  return usual.count > (usual.normal ? 6U : 3U);
}

/// The columns of a file, from its lines before the first point and from that one.
class Columns {
 public:
  /// A comment may name them, or speak of anything.
  void hear_comment(std::string_view line) {
    if (columns_) return;
    if (auto named = columns_named_by(without_comment_sign(line))) remarked_ = named;
  }

  /// Whether the line is taken for a heading, which stands once and before all points.
  bool is_heading(std::string_view line, const Row& row) {
    const bool may_be = !columns_ && !heading_seen_ && (!row.all_numbers || row.words == 1);
    if (!may_be) return false;
    heading_seen_ = true;
    named_ = columns_named_by(line);
    names_in_heading_ = names_of_columns(line);
    return true;
  }

  /// A line of words, where a heading stood before and no point yet.
  bool is_second_heading(const Row& row) const {
    return heading_seen_ && !columns_ && row.words > 0 && !row.any_number;
  }

  /// Nobody named them.
  bool are_guessed() const { return guessed_; }

  /// What the user should know of those that are not used.
  std::vector<std::string> notes() const {
    if (!columns_) return {};
    if (columns_->has_noise_without_unit) return {kNoteOfNoiseWithoutUnit};
    if (!guessed_ || !leave_some_out(*columns_)) return {};
    return {fmt::format(
        "of {} columns that no heading names, the first three were taken for x, y and z, and the "
        "others were not used: name those that count in a heading, x, y, z, nx, ny, nz, sigma_mm",
        columns_->count)};
  }

  /// Of a line, which is of so many numbers.
  Result<TextColumns> of(std::string_view line, std::size_t words, const std::string& file,
                         std::size_t number) {
    if (!columns_ && named_) columns_ = named_;
    if (!columns_ && remarked_ && remarked_->count == words) columns_ = remarked_;
    if (!columns_) {
      columns_ = usual_columns(words);
      const bool leaves_some_out = columns_ && leave_some_out(*columns_);
      if (leaves_some_out && has_commas_within_words(line)) {
        return bad_line(file, number, "has commas and blanks, so the numbers cannot be told");
      }
      if (leaves_some_out && words == names_in_heading_) {
        return bad_line(file, number, "has columns of which its heading names no x, y and z");
      }
      guessed_ = true;
    }
    if (!columns_) return bad_line(file, number, "is no point");
    if (columns_->count == words) return *columns_;
    return bad_line(file, number,
                    fmt::format("has {} numbers, {} {}", words,
                                named_ ? "its heading" : "the first", columns_->count));
  }

 private:
  std::optional<TextColumns> columns_;
  std::optional<TextColumns> named_;
  std::optional<TextColumns> remarked_;
  std::size_t names_in_heading_ = 0;
  bool heading_seen_ = false;
  bool guessed_ = false;
};

/// How the commas of a file are meant: alike in all its lines that have commas or points.
class Commas {
 public:
  Result<void> check(std::string_view line, const std::string& file, std::size_t number) {
    if (line.find_first_of(",.") == line.npos) return {};
    const bool decimal = has_decimal_commas(line);
    if (are_decimal_.value_or(decimal) != decimal) {
      return bad_line(file, number,
                      "has decimal commas and others none, or none and others have them");
    }
    are_decimal_ = decimal;
    if (!decimal && has_commas_and_semicolons(line)) {
      return bad_line(file, number, "has commas and semicolons, so the numbers cannot be told");
    }
    return {};
  }

 private:
  std::optional<bool> are_decimal_;
};

void add_point(const Row& row, const TextColumns& columns, PointCloud& cloud) {
  const auto& v = row.values;
  const auto& [x, y, z] = columns.position;
  cloud.positions.emplace_back(v[x], v[y], v[z]);
  if (columns.normal) {
    const auto& [nx, ny, nz] = *columns.normal;
    cloud.normals.emplace_back(v[nx], v[ny], v[nz]);
  }
  if (columns.sigma_mm) cloud.sigma_mm.push_back(v[*columns.sigma_mm]);
}

}  // namespace

Result<RawCloud> read_text_cloud(std::string_view text, const std::string& file) {
  RawCloud raw;
  raw.format = "text";
  TextLines lines(without_byte_order_mark(text));
  std::size_t number = 0;
  Columns columns;
  Commas commas;
  while (const auto line = lines.next()) {
    ++number;
    if (is_empty_or_comment(*line)) {
      columns.hear_comment(*line);
      continue;
    }
    const Row row = parse_row(*line);
    if (has_quoted_numbers(*line)) {
      return fail(ErrorCode::kCorruptData,
                  fmt::format("line {} of {} has its numbers in quotes", number, file),
                  "export it without quotes round numbers");
    }
    if (columns.is_heading(*line, row)) continue;
    if (columns.is_second_heading(row)) {
      return fail(ErrorCode::kCorruptData,
                  fmt::format("line {} of {} is a second heading", number, file),
                  "leave one line before the points, which names the columns; begin all others "
                  "with #");
    }
    if (!row.all_numbers || row.words > kMostColumns) return no_point(row, file, number);
    const auto own = columns.of(*line, row.words, file, number);
    if (!own) return tl::unexpected(own.error());
    if (auto clear = commas.check(*line, file, number); !clear) {
      return tl::unexpected(clear.error());
    }
    if (raw.cloud.size() >= kMostFilePoints) {
      return fail(ErrorCode::kUnsupported,
                  fmt::format("{} has more than {} points", file, kMostFilePoints), "thin it out");
    }
    add_point(row, *own, raw.cloud);
  }
  raw.are_normals_guessed = columns.are_guessed() && raw.cloud.has_normals();
  raw.notes = columns.notes();
  return raw;
}

bool looks_like_text_cloud(std::string_view text) {
  TextLines lines(without_byte_order_mark(text));
  int looked_at = 0;
  bool has_named_columns = false;
  while (const auto line = lines.next()) {
    if (is_empty_or_comment(*line)) continue;
    const Row row = parse_row(*line);
    if ((row.all_numbers && row.words >= 3) || has_quoted_numbers(*line)) return true;
    if (has_named_columns && row.any_number) return true;
    has_named_columns = has_named_columns || columns_named_by(*line).has_value();
    if (++looked_at > kMostLinesBefore) return false;
  }
  return false;
}

}  // namespace instep
