#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep {

/// For each point the index of the first one at its place: its own, unless an earlier one lies
/// there. Only exactly equal coordinates count as one place (0 and -0 are equal); they must be
/// finite. Joins what a file names again and again, such as the corners of a triangle soup.
/// O(n log n).
std::vector<std::size_t> first_at_same_place(const std::vector<Eigen::Vector3d>& points);

/// The index of the first point at each place, ascending: who says a thing twice adds nothing to
/// it, but a crowd at one place makes every neighbourhood there empty of all else, and a spacing of
/// nothing. Only exactly equal coordinates count as one place; they must be finite. O(n log n).
std::vector<std::size_t> distinct_points(const std::vector<Eigen::Vector3d>& points);

/// The same of a cloud: the index of the point that counts at each place (counts_before()).
std::vector<std::size_t> distinct_points(const PointCloud& cloud);

/// Which of two points at one place counts, by what is told of them and not by their order in the
/// cloud. One that was seen counts before one that was not. Two that were seen are one measurement
/// told twice, for two never meet exactly: so their sigmas are not averaged by inverse variance,
/// which would make it more certain than it was. The larger one counts, since too small a sigma
/// gives a wrong girth and too large a one a wide interval; where they agree, the lesser normal,
/// then the lesser view direction, coordinate by coordinate.
bool counts_before(const PointCloud& cloud, std::size_t one, std::size_t other);

}  // namespace instep
