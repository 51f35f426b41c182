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

/// With four sides so long and two corners of that many degrees, both on the first axis.
PrismCorners rhombus(double degrees, double side);

/// Where one is after so long a way round the corners, from the first.
Eigen::Vector2d place_round(const PrismCorners& corners, double way);

/// Bare points at random, of heights within 25 of 0, each off by so much noise along each axis.
PointCloud prism_points(const PrismCorners& corners, int count, std::uint64_t seed,
                        double sigma = 0.0);

/// The same with the normals of their sides, exact.
PointCloud faced_prism_points(const PrismCorners& corners, int count, std::uint64_t seed);

}  // namespace instep::test
