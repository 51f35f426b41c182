#pragma once

#include "core/girth/band/plane_band.h"

namespace instep::test {

/// A band without points, its origin that of the plane.
inline PlaneBand empty_band() {
  return {.middle_mm = {0, 0},
          .points = {},
          .index = PointIndex({}),
          .sources = {},
          .shares = {},
          .errors_mm = {},
          .seen = {},
          .uneven = {},
          .scattered = {},
          .roughness = {}};
}

}  // namespace instep::test
