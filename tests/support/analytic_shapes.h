#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/geometry/point_cloud.h"
#include "core/girth/tape_plane.h"

namespace instep::test {

/// A body of revolution-like parameters: its surface is `at(angle, height)`, and it is inside where
/// `level` is negative.
struct AnalyticShape {
  std::function<Eigen::Vector3d(double angle, double height)> at;
  std::function<double(const Eigen::Vector3d&)> level;
};

/// Radii in x and y, along z.
AnalyticShape elliptic_cylinder(double a, double b);
/// A cone whose radius is `radius` at z = 0 and changes by `slope` with z.
AnalyticShape cone(double radius, double slope);
/// Half-axes; heights stay inside +-c.
AnalyticShape ellipsoid(double a, double b, double c);
/// |x/a|^power + |y/b|^power = 1, along z.
AnalyticShape superellipse(double a, double b, double power);
/// The outer skin of a bent tube: a torus round an axis along y through x = -bend.
AnalyticShape bent_tube(double bend, double radius);

/// Random points on the shape between the heights, with normal noise and no normals told.
PointCloud random_points(const AnalyticShape& shape, std::size_t count, double low, double high,
                         double sigma_mm, std::uint64_t seed);

/// Perimeter of the section of the shape: found along many rays on the plane from the foot of its
/// axis by bisection. For sections that are star-shaped about it.
double true_girth(const AnalyticShape& shape, const TapePlane& plane);

}  // namespace instep::test
