#include "daemon/cloud_files/text_columns.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <vector>

#include "daemon/cloud_files/error_properties.h"
#include "daemon/cloud_files/text_tokens.h"

namespace instep {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::string_view kMarks = ",;\t";

/// In lower case; what stands in brackets, and quotes, left out.
std::vector<std::string> names_in(std::string_view heading) {
  std::string plain;
  int depth = 0;
  for (const char letter : heading) {
    const bool opens = letter == '(' || letter == '[';
    const bool closes = letter == ')' || letter == ']';
    depth = std::max(0, depth + (opens ? 1 : 0) - (closes ? 1 : 0));
    if (depth > 0 || closes || letter == '"' || letter == '\'') continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  plain.resize(plain.find_last_not_of(" ,;\t\v\f") + 1);
  const std::string_view separators = plain.find_first_of(kMarks) == plain.npos ? kBlanks : kMarks;
  std::vector<std::string> names;
  std::string_view rest = plain;
  for (auto column = take_word(rest, separators); !column.empty();
       column = take_word(rest, separators)) {
    names.emplace_back(take_word(column, kBlanks));
  }
  return names;
}

/// Where one of the names for a column stands; nothing if nowhere, or at two places.
std::optional<std::size_t> place_of(const std::vector<std::string>& names,
                                    std::initializer_list<std::string> wanted) {
  std::optional<std::size_t> place;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(wanted.begin(), wanted.end(), names[i]) == wanted.end()) continue;
    if (place) return std::nullopt;
    place = i;
  }
  return place;
}

/// Each of the three in one of two spellings.
std::optional<std::array<std::size_t, 3>> places_of(const std::vector<std::string>& names,
                                                    std::array<const char*, 3> wanted,
                                                    std::array<const char*, 3> or_wanted) {
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = place_of(names, {wanted[axis], or_wanted[axis]});
    if (!place) return std::nullopt;
    places[axis] = *place;
  }
  return places;
}

}  // namespace

std::optional<TextColumns> usual_columns(std::size_t count) {
  if (count < 3) return std::nullopt;
  TextColumns columns;
  columns.count = count;
  if (count == 6) columns.normal = {3, 4, 5};
  return columns;
}

std::optional<TextColumns> columns_named_by(std::string_view heading) {
  const auto names = names_in(heading);
  const auto position = places_of(names, {"x", "y", "z"}, {"x_mm", "y_mm", "z_mm"});
  if (!position) return std::nullopt;
  TextColumns columns;
  columns.count = names.size();
  columns.position = *position;
  columns.normal = places_of(names, {"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"});
  columns.sigma_mm = place_of(names, {"sigma_mm"});
  columns.has_noise_without_unit = !columns.sigma_mm && place_of(names, {kNoiseWithoutUnit});
  return columns;
}

std::size_t names_of_columns(std::string_view heading) {
  return names_in(heading).size();
}

}  // namespace instep
