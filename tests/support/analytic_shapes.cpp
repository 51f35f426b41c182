#include "tests/support/analytic_shapes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/geometry/polygon.h"
#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

double signed_power(double base, double power) {
  return std::copysign(std::pow(std::abs(base), power), base);
}

/// Outward direction by the level's differences.
Vector3d normal_at(const AnalyticShape& shape, const Vector3d& place) {
  constexpr double kStep = 1e-5;
  Vector3d gradient;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    gradient[axis] = shape.level(place + step) - shape.level(place - step);
  }
  return gradient.normalized();
}

/// How far the surface is from a place inside along a direction.
double ray_length(const AnalyticShape& shape, const Vector3d& from, const Vector3d& direction) {
  double inside = 0.0;
  double outside = 1.0;
  while (shape.level(from + outside * direction) < 0.0) {
    outside += 1.0;
    if (outside > 1000.0) throw std::runtime_error("the section of the shape is open");
  }
  inside = outside - 1.0;
  for (int i = 0; i < 60; ++i) {
    const double half = 0.5 * (inside + outside);
    (shape.level(from + half * direction) < 0.0 ? inside : outside) = half;
  }
  return inside;
}

}  // namespace

AnalyticShape elliptic_cylinder(double a, double b) {
  return {[=](double angle, double height) {
            return Vector3d(a * std::cos(angle), b * std::sin(angle), height);
          },
          [=](const Vector3d& p) { return std::hypot(p.x() / a, p.y() / b) - 1.0; }};
}

AnalyticShape cone(double radius, double slope) {
  return {[=](double angle, double height) {
            const double r = radius + slope * height;
            return Vector3d(r * std::cos(angle), r * std::sin(angle), height);
          },
          [=](const Vector3d& p) { return p.head<2>().norm() - radius - slope * p.z(); }};
}

AnalyticShape ellipsoid(double a, double b, double c) {
  return {
      [=](double angle, double height) {
        const double part = std::sqrt(1.0 - height * height / (c * c));
        return Vector3d(a * part * std::cos(angle), b * part * std::sin(angle), height);
      },
      [=](const Vector3d& p) { return Vector3d(p.x() / a, p.y() / b, p.z() / c).norm() - 1.0; }};
}

AnalyticShape superellipse(double a, double b, double power) {
  return {[=](double angle, double height) {
            return Vector3d(a * signed_power(std::cos(angle), 2.0 / power),
                            b * signed_power(std::sin(angle), 2.0 / power), height);
          },
          [=](const Vector3d& p) {
            return std::pow(std::abs(p.x() / a), power) + std::pow(std::abs(p.y() / b), power) -
                   1.0;
          }};
}

AnalyticShape bent_tube(double bend, double radius) {
  return {[=](double angle, double height) {
            const double way = bend + radius * std::cos(angle);
            const double turn = height / bend;
            return Vector3d(way * std::cos(turn) - bend, radius * std::sin(angle),
                            way * std::sin(turn));
          },
          [=](const Vector3d& p) {
            return std::hypot(std::hypot(p.x() + bend, p.z()) - bend, p.y()) - radius;
          }};
}

PointCloud random_points(const AnalyticShape& shape, std::size_t count, double low, double high,
                         double sigma_mm, std::uint64_t seed) {
  RandomNumbers random(seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3d place = shape.at(angle, random.uniform(low, high));
    const double offset = sigma_mm * random.normal();
    cloud.positions.push_back(sigma_mm > 0.0 ? Vector3d(place + offset * normal_at(shape, place))
                                             : place);
  }
  return cloud;
}

double true_girth(const AnalyticShape& shape, const TapePlane& plane) {
  constexpr int kRays = 20000;
  const Vector3d middle(0.0, 0.0, plane.origin().dot(plane.normal()) / plane.normal().z());
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRays;
    const Vector3d direction = std::cos(angle) * plane.u() + std::sin(angle) * plane.v();
    section.push_back(plane.project(middle + ray_length(shape, middle, direction) * direction));
  }
  return perimeter(section);
}

}  // namespace instep::test
