#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace instep {

/// The unit of the coordinates in a file. Files rarely say; kAuto decides by the body's size.
enum class LengthUnit { kMillimetre, kCentimetre, kMetre, kAuto };

/// "mm", "cm", "m", "auto".
const char* to_string(LengthUnit unit);
std::optional<LengthUnit> length_unit_from_string(std::string_view text);

/// Millimetres in one of `unit` (not kAuto).
double millimetres_in(LengthUnit unit);

/// The unit in which a body of this extent (its longest side without strays, in file units, finite
/// and not negative) is to be read. A given unit is kept unless it makes the body smaller than 2 mm
/// or larger than 20 m: then it fails with kInvalidInput and names the unit to ask for. kAuto takes
/// the unit in which the body is foot-like, 100 to 1000 mm, and fails if there is none.
Result<LengthUnit> settle_unit(LengthUnit unit, double extent, const std::string& file);

/// What the user should know of a unit that was given and makes the body so small or so large,
/// below 50 mm or above 2 m, that it may be another: a foot in centimetres read as millimetres.
/// Nothing where the size is likely.
std::optional<std::string> doubt_of_unit(LengthUnit unit, double extent);

/// The same of a body of which most points span only `extent_of_most`: where that is likely, a few
/// lie far away, and the unit is not what is wrong.
std::optional<std::string> doubt_of_size(LengthUnit unit, double extent, double extent_of_most);

}  // namespace instep
