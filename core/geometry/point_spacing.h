#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_index.h"

namespace instep {

/// How far apart the points of a surface are: the side of the square that each has for itself. Of
/// points at random the nearest other one is half as far off.

/// So many neighbours tell the spacing of a point.
inline constexpr std::size_t kSpacingNeighbours = 8;

/// Of points of which `count` lie within `reach` of a place; no fewer than one.
double spacing_within(double reach, std::size_t count);

/// Of a point whose `nearest`, at least itself, are given.
double own_spacing(const std::vector<PointIndex::Neighbour>& nearest);

/// Of a point of the index, by the distance to its eighth neighbour. O(log n).
double own_spacing(const PointIndex& index, const Eigen::Vector3d& point);

/// The middle one of the spacings of some `sample` points (fewer than twice as many) spread over
/// the list. Zero for fewer than two points.
double usual_spacing(const PointIndex& index, std::size_t sample);

/// Another measure: the median distance from a point to its nearest other point, over an even
/// sample of some 2000 points (fewer than twice as many). Zero for fewer than two points.
double median_nearest_distance(const PointIndex& index);

}  // namespace instep
