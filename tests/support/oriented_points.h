#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/surface/oriented_point.h"

namespace instep::test {

/// Evenly random over a disc of the plane through `middle`; each point is told its true normal and
/// variance, and lies off along that normal by that much noise.
std::vector<OrientedPoint> disc_points(const Eigen::Vector3d& middle, const Eigen::Vector3d& normal,
                                       double radius, std::size_t count, double sigma,
                                       std::uint64_t seed);

/// Random over the top of a sphere round the origin, out to `reach` from the z axis.
std::vector<OrientedPoint> cap_points(double sphere_radius, double reach, std::size_t count,
                                      double sigma, std::uint64_t seed);

/// Even over a whole sphere round the origin (a Fibonacci spiral).
std::vector<OrientedPoint> sphere_points(double radius, std::size_t count, double sigma,
                                         std::uint64_t seed);

/// A grid with a point every `spacing` round each wall of a square prism of side `side` along z.
std::vector<OrientedPoint> prism_points(double side, double height, double spacing, double sigma,
                                        std::uint64_t seed);

/// Heights over the plane z = 0 without what their best quadratic has of x^2: a cylinder along y
/// that fits them best is flat.
std::vector<OrientedPoint> without_bend_round(std::vector<OrientedPoint> points);

std::vector<OrientedPoint> in_another_order(std::vector<OrientedPoint> points, std::uint64_t seed);

/// The same body in a unit `factor` times as small.
std::vector<OrientedPoint> scaled(std::vector<OrientedPoint> points, double factor);

std::vector<Eigen::Vector3d> positions_of(const std::vector<OrientedPoint>& points);

/// Central differences of a field.
Eigen::Vector3d slope_by_differences(const std::function<double(const Eigen::Vector3d&)>& field,
                                     const Eigen::Vector3d& place, double step);

}  // namespace instep::test
