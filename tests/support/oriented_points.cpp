#include "tests/support/oriented_points.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;
using OrientedPoints = std::vector<OrientedPoint>;

OrientedPoint noisy(const Vector3d& position, const Vector3d& normal, double sigma,
                    RandomNumbers& random) {
  return {position + sigma * random.normal() * normal, normal, sigma * sigma};
}

}  // namespace

OrientedPoints disc_points(const Vector3d& middle, const Vector3d& normal, double radius,
                           std::size_t count, double sigma, std::uint64_t seed) {
  RandomNumbers random(seed);
  const Vector3d along = normal.unitOrthogonal();
  const Vector3d across = normal.cross(along);
  OrientedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    const double reach = radius * std::sqrt(random.uniform());
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    points.push_back(noisy(middle + reach * (std::cos(angle) * along + std::sin(angle) * across),
                           normal, sigma, random));
  }
  return points;
}

OrientedPoints cap_points(double sphere_radius, double reach, std::size_t count, double sigma,
                          std::uint64_t seed) {
  auto points = disc_points(Vector3d::Zero(), Vector3d::UnitZ(), reach, count, 0.0, seed);
  RandomNumbers random(seed + 1000);
  for (auto& point : points) {
    const double height =
        std::sqrt(sphere_radius * sphere_radius - point.position.head<2>().squaredNorm());
    point.position.z() = height;
    point = noisy(point.position, point.position.normalized(), sigma, random);
  }
  return points;
}

OrientedPoints sphere_points(double radius, std::size_t count, double sigma, std::uint64_t seed) {
  RandomNumbers random(seed);
  OrientedPoints points;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double ring = std::sqrt(1.0 - z * z);
    const double angle = turn * static_cast<double>(i);
    const Vector3d normal(ring * std::cos(angle), ring * std::sin(angle), z);
    points.push_back(noisy(radius * normal, normal, sigma, random));
  }
  return points;
}

OrientedPoints prism_points(double side, double height, double spacing, double sigma,
                            std::uint64_t seed) {
  RandomNumbers random(seed);
  const auto columns = static_cast<int>(std::lround(side / spacing));
  const auto rows = static_cast<int>(std::lround(height / spacing));
  OrientedPoints points;
  for (int wall = 0; wall < 4; ++wall) {
    const Eigen::AngleAxisd turn(wall * std::numbers::pi / 2.0, Vector3d::UnitZ());
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const Vector3d place(side / 2.0, -side / 2.0 + (column + 0.5) * spacing,
                             -height / 2.0 + row * spacing);
        points.push_back(noisy(turn * place, turn * Vector3d::UnitX(), sigma, random));
      }
    }
  }
  return points;
}

std::vector<OrientedPoint> without_bend_round(std::vector<OrientedPoint> points) {
  Eigen::MatrixXd quadratics(static_cast<Eigen::Index>(points.size()), 6);
  Eigen::VectorXd heights(quadratics.rows());
  for (Eigen::Index i = 0; i < quadratics.rows(); ++i) {
    const Eigen::Vector3d& at = points[static_cast<std::size_t>(i)].position;
    quadratics.row(i) << 1.0, at.x(), at.y(), at.x() * at.x(), at.x() * at.y(), at.y() * at.y();
    heights[i] = at.z();
  }
  const double bend = quadratics.colPivHouseholderQr().solve(heights)[3];
  for (auto& point : points) point.position.z() -= bend * point.position.x() * point.position.x();
  return points;
}

OrientedPoints in_another_order(OrientedPoints points, std::uint64_t seed) {
  RandomNumbers random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

OrientedPoints scaled(OrientedPoints points, double factor) {
  for (auto& point : points) {
    point.position *= factor;
    point.variance *= factor * factor;
  }
  return points;
}

std::vector<Vector3d> positions_of(const OrientedPoints& points) {
  std::vector<Vector3d> positions;
  for (const auto& point : points) positions.push_back(point.position);
  return positions;
}

Vector3d slope_by_differences(const std::function<double(const Vector3d&)>& field,
                              const Vector3d& place, double step) {
  Vector3d slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d shift = step * Vector3d::Unit(axis);
    slope[axis] = (field(place + shift) - field(place - shift)) / (2.0 * step);
  }
  return slope;
}

}  // namespace instep::test
