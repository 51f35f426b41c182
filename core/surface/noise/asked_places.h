#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// A place whose neighbourhood is asked what it shows of noise.
struct AskedPlace {
  std::size_t point = 0;
  bool between = false;  ///< put where those before and after it lie far apart
};

/// Of `places`, points of `index` in the order in which they lie round a body, every so many-th,
/// some 24 to 47: what is usual among them is so of the points. A part that was seen from afar, and
/// so scatters most, has the fewest of those; where they lie plainly further from each other than
/// they do as a rule, more are put between them, so that each part is heard; not where something is
/// missing. In the same order; at most about four times as many, whatever the points.
std::vector<AskedPlace> asked_places(const PointIndex& index,
                                     const std::vector<std::size_t>& places);

}  // namespace instep
