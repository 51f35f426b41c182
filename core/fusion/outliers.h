#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// The points, as ascending indices, that are not alone: statistical outliers are those with far
/// fewer points round them than is usual in this cloud. One sort of the points.
std::vector<std::size_t> crowded_points(const PointCloud& cloud);

/// The points, as ascending indices, of clusters that are not small: of 50 points at least.
std::vector<std::size_t> clustered_points(const PointCloud& cloud);

}  // namespace instep
