#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep::test {

/// The body round which most tests lay a tape: a cylinder of radius 40 mm along z.
inline constexpr double kCylinderRadius = 40.0;
inline constexpr double kCylinderGirth = 2.0 * std::numbers::pi * kCylinderRadius;

/// Random points on it from 30 mm below the origin to 30 mm above, with normal noise.
PointCloud cylinder(std::size_t count, double sigma_mm = 0.0, std::uint64_t seed = 5);

/// Rings of equally spaced points on it, upwards from z = 0, as in the paper's Table 2.
PointCloud rings(int per_ring, int count, double pitch);

/// The plane through three points that span one.
TapePlane plane_at(const Eigen::Vector3d& c1, const Eigen::Vector3d& c2, const Eigen::Vector3d& c3);

/// Across its axis, and obliquely through it.
TapePlane level_plane(double height = 1.3);
TapePlane oblique_plane();

}  // namespace instep::test
