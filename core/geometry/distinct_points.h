#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace instep {

/// The index of the first point at each place, ascending: who says a thing twice adds nothing to
/// it, but a crowd at one place makes every neighbourhood there empty of all else, and a spacing of
/// nothing. Only exactly equal coordinates count as one place; they must be finite. O(n log n).
std::vector<std::size_t> distinct_points(const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
