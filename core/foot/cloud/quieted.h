#pragma once

#include <cstddef>
#include <optional>

#include "core/foot/cloud/scanner_lines.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// How a noisy cloud is quieted.
struct Quieting {
  double noise_mm = 0.0;   ///< standard deviation that the points show along the skin's normal
  double length_mm = 0.0;  ///< of the foot: skin bends within circles in proportion
  std::size_t parts = 1;   ///< that the cloud was parted into: this is one of them
};

/// A noisy cloud as its shape is read off it.
struct QuietedCloud {
  PointCloud cloud;  ///< some of the points, each on the skin that its neighbours show
  Quieting quieting;
};

/// Points that are kept of a whole cloud; more show a foot no better, for their neighbours count.
inline constexpr std::size_t kMostQuieted = 20000;

/// Standard deviation of the noise where it is so much that it moves what is read off single
/// points: the floor, the ends, the borders. By the outermost of its points a foot with 2 mm of
/// noise was 3 mm too long, for all that robust_extreme() does. `lines`: of a scanner, if the
/// points stand in some. `cloud` has passed check_cloud(). Some 10 ms.
std::optional<double> moving_noise_mm(const PointCloud& cloud,
                                      const std::optional<ScannerLines>& lines = std::nullopt);

/// Each point is put on a quadratic surface through those round it, of a circle that is wider the
/// more the cloud scatters and the fewer they are there: 6 to 12 mm on a foot of full size
/// (full_size.h). Points amid one circle share it. Strays that lie far off it, points with fewer
/// than a dozen round them, and those that nobody saw, which tell nothing of others, stay where
/// they are.
///
/// No more than kMostQuieted are kept, and no more than 100,000 are asked, the same ones in
/// whatever order they come; of a part as much less, so that parts tell how sure the whole is.
/// O(n log n): a quarter of a second, of a part much less.
QuietedCloud quieted(const PointCloud& cloud, const Quieting& quieting);

}  // namespace instep
