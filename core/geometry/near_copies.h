#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// Which points lie within `apart` > 0 of one that comes before them and stays: nearly its copies,
/// such as a cloud that was merged with itself has. They tell nothing new, and as noise that is the
/// same in both they look like a surface without noise. O(n log n).
std::vector<bool> near_copies(const std::vector<Eigen::Vector3d>& points, double apart);

/// The share of some `sample` points (fewer than twice as many), spread over the list, that have
/// another within `apart`.
double share_of_near_copies(const PointIndex& index, double apart, std::size_t sample);

}  // namespace instep
