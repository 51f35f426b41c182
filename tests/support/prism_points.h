#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/geometry/point_cloud.h"

namespace instep::test {

/// An upright body by the corners of its section, counter-clockwise.
using PrismCorners = std::vector<Eigen::Vector2d>;

/// With that many sides, on an ellipse with these half axes.
PrismCorners many_sided(int sides, double along, double across);

/// Where one is after so long a way round the corners, from the first.
Eigen::Vector2d place_round(const PrismCorners& corners, double way);

/// Bare points at random, of heights within 25 of 0.
PointCloud prism_points(const PrismCorners& corners, int count, std::uint64_t seed);

}  // namespace instep::test
