#pragma once

#include <numbers>

namespace instep {

/// In radians.
inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace instep
