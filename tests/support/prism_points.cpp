#include "tests/support/prism_points.h"

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"
#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

/// The corner behind, and the way from there.
struct Station {
  std::size_t corner;
  double rest;
};

Eigen::Vector2d side_from(const PrismCorners& corners, std::size_t corner) {
  return corners[(corner + 1) % corners.size()] - corners[corner];
}

Station station_at(const PrismCorners& corners, double way) {
  std::size_t corner = 0;
  for (; way >= side_from(corners, corner).norm(); corner = (corner + 1) % corners.size()) {
    way -= side_from(corners, corner).norm();
  }
  return {corner, way};
}

}  // namespace

PrismCorners many_sided(int sides, double along, double across) {
  PrismCorners corners;
  for (int i = 0; i < sides; ++i) {
    const double turn = 2.0 * std::numbers::pi * (i + 0.5) / sides;
    corners.emplace_back(along * std::cos(turn), across * std::sin(turn));
  }
  return corners;
}

PrismCorners rhombus(double degrees, double side) {
  const double half = 0.5 * degrees * std::numbers::pi / 180.0;
  const double along = side * std::cos(half);
  const double across = side * std::sin(half);
  return {{along, 0.0}, {0.0, across}, {-along, 0.0}, {0.0, -across}};
}

Eigen::Vector2d place_round(const PrismCorners& corners, double way) {
  const auto [corner, rest] = station_at(corners, way);
  return corners[corner] + rest * side_from(corners, corner).normalized();
}

PointCloud faced_prism_points(const PrismCorners& corners, int count, std::uint64_t seed) {
  RandomNumbers random(seed);
  PointCloud cloud;
  for (int i = 0; i < count; ++i) {
    const double way = random.uniform(0.0, perimeter(corners));
    const auto place = place_round(corners, way);
    const Eigen::Vector2d along = side_from(corners, station_at(corners, way).corner).normalized();
    cloud.positions.emplace_back(place.x(), place.y(), random.uniform(-25.0, 25.0));
    cloud.normals.emplace_back(along.y(), -along.x(), 0.0);
  }
  return cloud;
}

PointCloud prism_points(const PrismCorners& corners, int count, std::uint64_t seed, double sigma) {
  PointCloud cloud = faced_prism_points(corners, count, seed);
  cloud.normals.clear();
  if (!(sigma > 0.0)) return cloud;
  RandomNumbers random(seed + 1);
  for (auto& place : cloud.positions) {
    place += sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  }
  return cloud;
}

}  // namespace instep::test
