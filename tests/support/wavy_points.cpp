#include "tests/support/wavy_points.h"

#include <cmath>

#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep::test {

std::vector<OrientedPoint> wavy_points(std::size_t count, double amplitude, double sigma,
                                       std::uint64_t seed, double waves) {
  auto points =
      disc_points(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), 1.0, count, sigma, seed);
  for (auto& point : points) {
    point.position.z() += amplitude * std::sin(6 * waves * point.position.x()) *
                          std::cos(5 * waves * point.position.y());
  }
  return points;
}

std::vector<OrientedPoint> uneven_points(std::size_t count) {
  auto points = wavy_points(count, 0.0, 0.0, 5);
  RandomNumbers random(4);
  for (auto& point : points) point.position.z() += random.uniform(-0.1, 0.1);
  return points;
}

}  // namespace instep::test
