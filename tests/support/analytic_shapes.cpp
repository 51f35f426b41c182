#include "tests/support/analytic_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
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

AnalyticShape lobed_cylinder(double radius, double depth, int lobes) {
  const auto radius_at = [=](double angle) { return radius + depth * std::cos(lobes * angle); };
  return {
      [=](double angle, double height) {
        const double r = radius_at(angle);
        return Vector3d(r * std::cos(angle), r * std::sin(angle), height);
      },
      [=](const Vector3d& p) { return p.head<2>().norm() - radius_at(std::atan2(p.y(), p.x())); }};
}

AnalyticShape flat_soled_cylinder(double a, double b, double sole) {
  return {[=](double angle, double height) {
            const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
            const double skin = 1.0 / std::hypot(ray.x() / a, ray.y() / b);
            const double r = ray.y() * skin < -sole ? -sole / ray.y() : skin;
            return Vector3d(r * ray.x(), r * ray.y(), height);
          },
          [=](const Vector3d& p) {
            return std::max(std::hypot(p.x() / a, p.y() / b) - 1.0, -p.y() / sole - 1.0);
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

PointCloud points_by_area(const AnalyticShape& shape, std::size_t count, double low, double high,
                          std::uint64_t seed) {
  RandomNumbers random(seed);
  const auto area_at = [&](double angle, double height) {
    constexpr double kStep = 1e-5;
    return (shape.at(angle + kStep, height) - shape.at(angle - kStep, height))
               .cross(shape.at(angle, height + kStep) - shape.at(angle, height - kStep))
               .norm() /
           (4.0 * kStep * kStep);
  };
  const auto somewhere = [&] {
    return std::pair(random.uniform(0.0, 2.0 * std::numbers::pi), random.uniform(low, high));
  };
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const auto [angle, height] = somewhere();
    largest = std::max(largest, area_at(angle, height));
  }
  PointCloud cloud;
  while (cloud.size() < count) {
    const auto [angle, height] = somewhere();
    if (random.uniform() * largest > area_at(angle, height)) continue;
    cloud.positions.push_back(shape.at(angle, height));
    cloud.normals.push_back(normal_at(shape, cloud.positions.back()));
  }
  return cloud;
}

PointCloud cylinder_rings(int per_ring, int rings, double pitch_mm, double twist) {
  PointCloud cloud;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < per_ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + twist * ring) / per_ring;
      cloud.positions.emplace_back(40.0 * std::cos(angle), 40.0 * std::sin(angle),
                                   pitch_mm * (ring - 0.5 * (rings - 1)));
    }
  }
  return cloud;
}

std::vector<Eigen::Vector2d> true_section(const AnalyticShape& shape, const TapePlane& plane,
                                          int rays) {
  const Vector3d middle(0.0, 0.0, plane.origin().dot(plane.normal()) / plane.normal().z());
  std::vector<Eigen::Vector2d> section;
  for (int i = 0; i < rays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / rays;
    const Vector3d direction = std::cos(angle) * plane.u() + std::sin(angle) * plane.v();
    section.push_back(plane.project(middle + ray_length(shape, middle, direction) * direction));
  }
  return section;
}

double true_girth(const AnalyticShape& shape, const TapePlane& plane) {
  return perimeter(true_section(shape, plane, 20000));
}

}  // namespace instep::test
