#include "tests/support/cylinder_tape.h"

#include <cmath>

#include "tests/support/analytic_shapes.h"

namespace instep::test {

PointCloud cylinder(std::size_t count, double sigma_mm, std::uint64_t seed) {
  return random_points(elliptic_cylinder(kCylinderRadius, kCylinderRadius), count, -30, 30,
                       sigma_mm, seed);
}

PointCloud rings(int per_ring, int count, double pitch) {
  PointCloud cloud;
  for (int ring = 0; ring < count; ++ring) {
    for (int i = 0; i < per_ring; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / per_ring;
      cloud.positions.emplace_back(kCylinderRadius * std::cos(angle),
                                   kCylinderRadius * std::sin(angle), pitch * ring);
    }
  }
  return cloud;
}

TapePlane plane_at(const Eigen::Vector3d& c1, const Eigen::Vector3d& c2,
                   const Eigen::Vector3d& c3) {
  return TapePlane::through(c1, c2, c3).value();
}

TapePlane level_plane(double height) {
  return plane_at({0, 0, height}, {1, 0, height}, {0, 1, height});
}

TapePlane oblique_plane() {
  return plane_at({0, 0, -2}, {10, 0, 1}, {0, 10, 2});
}

}  // namespace instep::test
