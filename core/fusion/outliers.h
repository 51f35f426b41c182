#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

struct OutlierSettings {
  double reach_mm = 3.0;      ///< how far a point looks for company
  double least_crowd = 0.15;  ///< of the median number of points round a point; fewer are strays
  double link_mm = 3.0;       ///< points within about this (up to twice) belong together
  std::size_t least_cluster = 50;  ///< smaller groups of points are strays
};

/// The points, as ascending indices, that are not alone: statistical outliers are those with far
/// fewer points round them than is usual in this cloud. One sort of the points.
std::vector<std::size_t> crowded_points(const PointCloud& cloud, const OutlierSettings& settings);

/// The points, as ascending indices, of clusters that are not small.
std::vector<std::size_t> clustered_points(const PointCloud& cloud, const OutlierSettings& settings);

}  // namespace instep
