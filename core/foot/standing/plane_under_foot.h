#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/foot/standing/standing_plane.h"
#include "core/geometry/point_cloud.h"
#include "core/result.h"

namespace instep {

// Planes under feet of any size, each told at full size (full_size.h).

/// How long a foot about is, whatever its pose: as it stands, or where it does not along the
/// direction in which its points spread most. A tenth of a second at most. At least one point.
double rough_length_mm(const PointCloud& cloud);

/// As find_standing_plane().
Result<StandingPlane> plane_under_foot(const PointCloud& cloud);

/// As settled_on_sole(), of a foot that stood on z = 0 and is so long.
StandingPlane plane_again(const std::vector<Eigen::Vector3d>& points, double length_mm);

}  // namespace instep
