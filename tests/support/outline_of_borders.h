#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/foot/skin/foot_outline.h"

namespace instep::test {

inline constexpr std::size_t kPointsOfBorders = 20000;

/// How far a foot reaches to one side at each x of 0 to its length, mm.
using Border = std::function<double(double)>;

/// A foot that is nothing but walls round in height, whose furthest places make a given border to
/// either side of it: all that the points of the ball and the sides of the toes are told from.
/// `is_seen`, by x and whether medial: elsewhere the wall is put 12 mm too far in by a platform.
FootOutline outline_with(const Border& medial, const Border& lateral, double length_mm,
                         double noise_mm, std::uint64_t seed, std::size_t points = kPointsOfBorders,
                         const std::function<bool(double, bool)>& is_seen = {});

}  // namespace instep::test
