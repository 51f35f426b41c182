#pragma once

#include <Eigen/Core>
#include <vector>

namespace instep {

/// The step that all coordinates of points are rounded to, as by whoever wrote them with few
/// digits, or took them from voxels: the finest one of the axes, for rows of a scanner step along
/// one axis alone. That of their number format at least; zero of points that were turned since, or
/// are all one. O(n log n).
double coordinate_step(const std::vector<Eigen::Vector3d>& points);

/// Whether coordinate_step() is larger than `least`. Quick where a few hundred of the points show
/// two numbers nearer to each other than that: then it cannot be.
bool is_coordinate_step_over(double least, const std::vector<Eigen::Vector3d>& points);

}  // namespace instep
