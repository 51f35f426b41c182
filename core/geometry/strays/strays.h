#pragma once

#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// How hard strays are looked for.
struct StrayHunt {
  double known_share = 0.0;  ///< of all points, those left out before
  bool near_skin = false;    ///< also near the skin, be there others or not
};

/// Which points are strays: first those that stand alone (stray_points()). Of many, some have
/// others of their kind beside them (hovering_points()); of more, some came to lie near the skin
/// (off_skin_points()), and those are looked for last. Clean noisy clouds have a fortieth of a
/// percent that stand alone.
///
/// `spacing` > 0: of most points. O(n log n), of clean points little.
std::vector<bool> strays_among(const PointIndex& index, double spacing, const StrayHunt& hunt = {});

}  // namespace instep
