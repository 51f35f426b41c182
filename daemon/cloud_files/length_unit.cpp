#include "daemon/cloud_files/length_unit.h"

#include <fmt/core.h>

#include <array>

namespace instep {
namespace {

constexpr std::array kUnits = {LengthUnit::kMillimetre, LengthUnit::kCentimetre,
                               LengthUnit::kMetre};
constexpr double kSmallestBody_mm = 2.0;
constexpr double kLargestBody_mm = 20000.0;
constexpr double kSmallestFoot_mm = 100.0;
constexpr double kLargestFoot_mm = 1000.0;
constexpr double kSmallestLikely_mm = 50.0;
constexpr double kLargestLikely_mm = 2000.0;
constexpr double kMicrometresInMillimetre = 1000.0;

std::optional<LengthUnit> foot_like_unit(double extent) {
  for (const LengthUnit unit : kUnits) {
    const double size_mm = extent * millimetres_in(unit);
    if (size_mm >= kSmallestFoot_mm && size_mm < kLargestFoot_mm) return unit;
  }
  return std::nullopt;
}

bool is_foot_in_micrometres(double extent) {
  const double size_mm = extent / kMicrometresInMillimetre;
  return size_mm >= kSmallestFoot_mm && size_mm < kLargestFoot_mm;
}

/// What to do about a body that is no foot in the unit that was given.
std::string advice_on_unit(double extent) {
  if (const auto likely = foot_like_unit(extent)) {
    return fmt::format("it is probably in {0}, give --unit {0}", to_string(*likely));
  }
  if (is_foot_in_micrometres(extent)) {
    return "it is probably in micrometres, export it in mm, cm or m";
  }
  return "say its unit with --unit mm, --unit cm or --unit m";
}

}  // namespace

const char* to_string(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return "mm";
    case LengthUnit::kCentimetre:
      return "cm";
    case LengthUnit::kMetre:
      return "m";
    case LengthUnit::kAuto:
      return "auto";
  }
  return "auto";
}

std::optional<LengthUnit> length_unit_from_string(std::string_view text) {
  for (const LengthUnit unit : kUnits) {
    if (text == to_string(unit)) return unit;
  }
  if (text == to_string(LengthUnit::kAuto)) return LengthUnit::kAuto;
  return std::nullopt;
}

double millimetres_in(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kCentimetre:
      return 10.0;
    case LengthUnit::kMetre:
      return 1000.0;
    case LengthUnit::kMillimetre:
    case LengthUnit::kAuto:
      break;
  }
  return 1.0;
}

Result<LengthUnit> settle_unit(LengthUnit unit, double extent, const std::string& file) {
  if (extent == 0.0) {
    return fail(ErrorCode::kInsufficientData, fmt::format("all points of {} are the same", file),
                "scan or export it again");
  }
  if (unit == LengthUnit::kAuto) {
    if (const auto likely = foot_like_unit(extent)) return *likely;
    return fail(ErrorCode::kInvalidInput,
                fmt::format("{} spans {:.4g}, which is no foot in mm, cm or m", file, extent),
                advice_on_unit(extent));
  }
  const double size_mm = extent * millimetres_in(unit);
  if (size_mm >= kSmallestBody_mm && size_mm <= kLargestBody_mm) return unit;
  const std::string told =
      fmt::format("{} spans only {:.4g} mm if its unit is {}", file, size_mm, to_string(unit));
  const std::string huge =
      fmt::format("{} spans {:.4g} m if its unit is {}", file, size_mm / 1000.0, to_string(unit));
  return fail(ErrorCode::kInvalidInput, size_mm < kSmallestBody_mm ? told : huge,
              advice_on_unit(extent));
}

std::optional<std::string> doubt_of_unit(LengthUnit unit, double extent) {
  const double size_mm = extent * millimetres_in(unit);
  if (size_mm >= kSmallestLikely_mm && size_mm <= kLargestLikely_mm) return std::nullopt;
  return fmt::format("the body spans {:.4g} mm if its unit is {}: if it is a foot, {}", size_mm,
                     to_string(unit), advice_on_unit(extent));
}

std::optional<std::string> doubt_of_size(LengthUnit unit, double extent, double extent_of_most) {
  const auto doubt = doubt_of_unit(unit, extent);
  const double scale = millimetres_in(unit);
  const bool is_too_large = extent * scale > kLargestLikely_mm;
  if (!doubt || !is_too_large || doubt_of_unit(unit, extent_of_most)) return doubt;
  return fmt::format(
      "a few points lie far from all others, which span {:.4g} mm, and make the whole span {:.4g} "
      "mm: take them away if they are strays",
      extent_of_most * scale, extent * scale);
}

}  // namespace instep
