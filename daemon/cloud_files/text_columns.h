#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace instep {

/// Which of a line's numbers are what.
struct TextColumns {
  std::size_t count = 0;  ///< of all, those of no use included
  std::array<std::size_t, 3> position{0, 1, 2};
  std::optional<std::array<std::size_t, 3>> normal;
  std::optional<std::size_t> sigma_mm;
  bool has_noise_without_unit = false;  ///< a column "sigma", which is not used
};

/// As a line without a word about them has them: x y z first, and of six columns nx ny nz then;
/// nothing for fewer than three.
std::optional<TextColumns> usual_columns(std::size_t count);

/// As a heading names them, in any order and with others between: x, y, z (or x_mm ...), and
/// where it has them nx, ny, nz (or normal_x ...) and sigma_mm. Case, quotes and what stands in
/// brackets, such as a unit, do not matter; where commas, semicolons or tabs part the columns, nor
/// do words after the first. All columns hold numbers. Nothing for a heading that does not name
/// each of x, y and z once.
std::optional<TextColumns> columns_named_by(std::string_view heading);

/// How many columns a line has names for, if it is a heading, whatever they mean.
std::size_t names_of_columns(std::string_view heading);

}  // namespace instep
