#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// A noisy cloud as its shape is read off it.
struct QuietedCloud {
  PointCloud cloud;       ///< some of the points, each on the skin that its neighbours show
  double noise_mm = 0.0;  ///< standard deviation that the points show along the skin's normal
};

/// Points that are kept, which show a foot no worse than more.
inline constexpr std::size_t kMostQuieted = 20000;

/// Nothing where the points show less noise than moves what is read off single ones of them: the
/// floor, the ends, the borders. By the outermost of its points a foot with 2 mm of noise was 3 mm
/// too long, for all that robust_extreme() does.
///
/// Each point is put on a quadratic surface through its neighbours, of a circle that is wider the
/// more they scatter and the fewer they are, 6 to 12 mm; those amid one share it. Strays that lie
/// far off it stay where they are, and so do points that nobody saw. No more than kMostQuieted are kept. `cloud` has passed
/// check_cloud(). O(n log n): some 10 ms where points are quiet, a quarter of a second where not.
std::optional<QuietedCloud> quieted_if_noisy(const PointCloud& cloud);

/// The same of points whose noise is known, such as a part of the same cloud; no more than `most`.
PointCloud quieted(const PointCloud& cloud, double noise_mm, std::size_t most);

}  // namespace instep
