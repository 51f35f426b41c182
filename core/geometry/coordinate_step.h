#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The coarsest step that the coordinates of points are rounded to along one of their axes, as by
/// whoever wrote them with few digits, or took them from voxels; that of their number format at
/// least, and zero where an axis has one coordinate only. Points that were moved since show none.
/// O(n log n) for some thousands of the points.
double coordinate_step(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
