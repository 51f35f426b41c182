#pragma once

#include <cstddef>

#include "core/foot/foot_scan.h"
#include "core/geometry/point_cloud.h"

namespace instep {

/// The low part of a foot (of its shape()) whose sole was not seen, as far up as its walls' ends
/// may be seen and their bend is told by, at full size (full_size_factor()), as wall_end.h and
/// wall_foot.h look at it: in the foot's frame, with normals and without errors along them. Of more
/// points than `most_points` some, spread evenly. Of a cloud without normals those of a scanner's
/// line that runs alone are left out. Empty where too few are low.
struct LowWalls {
  LowWalls(const FootScan& foot, std::size_t most_points);

  double to_full_size = 1.0;
  PointCloud points;
};

}  // namespace instep
