#pragma once

#include <optional>

#include "core/geometry/quadratic_skin.h"

namespace instep {

struct SummitAcross {
  double across = 0.0;  ///< y
  double reach = 0.0;   ///< z
};

/// The highest place of the skin on the line x = 0, for y within limits.
std::optional<SummitAcross> summit_across(const SkinPatch& points, double from, double to);

}  // namespace instep
