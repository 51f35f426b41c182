#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

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
/// A cylinder along z whose radius swings by `depth` round `radius`, `lobes` times a turn: a deep
/// one has hollows that a stretched tape bridges.
AnalyticShape lobed_cylinder(double radius, double depth, int lobes);
/// An elliptic cylinder cut flat at y = -`sole`: two creases along z, as along a last's sole.
AnalyticShape flat_soled_cylinder(double a, double b, double sole);
/// The outer skin of a bent tube: a torus round an axis along y through x = -bend.
AnalyticShape bent_tube(double bend, double radius);

/// Random points on the shape between the heights, with normal noise and no normals told.
PointCloud random_points(const AnalyticShape& shape, std::size_t count, double low, double high,
                         double sigma_mm, std::uint64_t seed);

/// Random points on the shape between the heights, as many on each square millimetre, with their
/// true normals and no noise.
PointCloud points_by_area(const AnalyticShape& shape, std::size_t count, double low, double high,
                          std::uint64_t seed);

/// A cylinder of radius 40 mm as the paper's Table 2 has it: regular rings round z, the middle one
/// at z = 0. `twist`: of each ring against the one below it, in steps of its points.
PointCloud cylinder_rings(int per_ring, int rings, double pitch_mm, double twist);

/// The section of the shape in the plane's own coordinates, counter-clockwise: found along `rays`
/// on the plane from the foot of its axis by bisection. For sections that are star-shaped about it.
std::vector<Eigen::Vector2d> true_section(const AnalyticShape& shape, const TapePlane& plane,
                                          int rays);

/// Perimeter of the section.
double true_girth(const AnalyticShape& shape, const TapePlane& plane);

}  // namespace instep::test
