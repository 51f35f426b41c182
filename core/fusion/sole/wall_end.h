#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// How a piece of the wall of a foot ends below, as far as it was seen.
struct WallEnd {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the skin, about its lowest points
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< of the skin there, unit length
  double bend = 0.0;  ///< curvature there on the way up, 1/mm; below 0 where the skin is hollow
};

/// The ends of all walls that were seen lower than `most_z`, one for each 6 mm or so. Each is told
/// by an arc over the way up (a parabola takes the steep end of an arc for a straight one), with
/// the skin's bend and twist along the wall, through the points within `reach`, mm.
///
/// Neither the foot's back nor the upper part of a wall that goes on below is an end. The cloud has
/// normals; only their rough direction counts. About 3 ms for 40,000 points.
std::vector<WallEnd> find_wall_ends(const PointCloud& foot, double most_z, double reach);

}  // namespace instep
