#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep::test {

/// Over the unit disc, as deep as `amplitude`; `waves`: six and five radians of them for each unit,
/// at one.
std::vector<OrientedPoint> wavy_points(std::size_t count, double amplitude, double sigma,
                                       std::uint64_t seed, double waves = 1.0);

/// Over the unit disc, each up to a tenth off it.
std::vector<OrientedPoint> uneven_points(std::size_t count);

}  // namespace instep::test
