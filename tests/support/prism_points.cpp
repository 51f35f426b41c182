#include "tests/support/prism_points.h"

#include <cmath>
#include <numbers>

#include "core/geometry/polygon.h"
#include "tests/support/random_numbers.h"

namespace instep::test {

PrismCorners many_sided(int sides, double along, double across) {
  PrismCorners corners;
  for (int i = 0; i < sides; ++i) {
    const double turn = 2.0 * std::numbers::pi * (i + 0.5) / sides;
    corners.emplace_back(along * std::cos(turn), across * std::sin(turn));
  }
  return corners;
}

Eigen::Vector2d place_round(const PrismCorners& corners, double way) {
  for (std::size_t i = 0;; i = (i + 1) % corners.size()) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    if (way < side.norm()) return corners[i] + way * side.normalized();
    way -= side.norm();
  }
}

PointCloud prism_points(const PrismCorners& corners, int count, std::uint64_t seed) {
  RandomNumbers random(seed);
  PointCloud cloud;
  for (int i = 0; i < count; ++i) {
    const auto place = place_round(corners, random.uniform(0.0, perimeter(corners)));
    cloud.positions.emplace_back(place.x(), place.y(), random.uniform(-25.0, 25.0));
  }
  return cloud;
}

}  // namespace instep::test
