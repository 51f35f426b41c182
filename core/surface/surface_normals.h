#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Unit normals by principal components over the `count` nearest points (the paper, section 3.2);
/// their sign means nothing yet.
std::vector<Eigen::Vector3d> estimate_normals(const std::vector<Eigen::Vector3d>& points,
                                              const PointIndex& index, std::size_t count);

/// Turns normals to agree with their neighbours along a minimum spanning tree of the bends (Hoppe
/// 1992), then each connected part as a whole outwards: the sum of normal times place over a ring
/// round the third axis is twice its area, so it tells the side. Across an edge of a right angle
/// exact normals of its two sides tell nothing of each other; estimated ones bend over it.
void orient_by_neighbours(const std::vector<Eigen::Vector3d>& points, const PointIndex& index,
                          std::vector<Eigen::Vector3d>& normals);

}  // namespace instep
