#include "tests/support/bent_roof.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/point_index.h"
#include "tests/support/oriented_points.h"
#include "tests/support/random_numbers.h"

namespace instep::test {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbours = 8;

}  // namespace

Vector3d BentRoof::normal(double side, double reach) const {
  return {side * std::sin(pitch(side, reach)), 0.0, std::cos(pitch(side, reach))};
}

Vector3d BentRoof::at(double side, double reach, double y) const {
  const Vector3d chord = normal(side, reach) - normal(side, 0.0);
  return Vector3d(chord.x(), 0.0, chord.z()) / curvature(side) + Vector3d(0.0, y, 0.0);
}

double BentRoof::distance(const Vector3d& place) const {
  const auto over = [&](double side) {
    const Vector3d arm = place + normal(side, 0.0) / curvature(side);
    return std::hypot(arm.x(), arm.z()) - 1.0 / curvature(side);
  };
  return std::max(over(1.0), over(-1.0));
}

std::vector<OrientedPoint> BentRoof::points(std::size_t on_the_right, std::size_t on_the_left,
                                            std::uint64_t seed) const {
  RandomNumbers random(seed);
  std::vector<OrientedPoint> points;
  while (points.size() < on_the_right + on_the_left) {
    const double side = points.size() < on_the_right ? 1.0 : -1.0;
    const double reach = random.uniform(0.002, 0.9);
    points.push_back({at(side, reach, random.uniform(-0.8, 0.8)), normal(side, reach), 0.0, true});
  }
  return points;
}

std::vector<OrientedPoint> BentRoof::bare_points(std::size_t on_the_right, std::size_t on_the_left,
                                                 std::uint64_t seed) const {
  const auto told = points(on_the_right, on_the_left, seed);
  const PointIndex index(positions_of(told));
  auto bare = told;
  for (auto& point : bare) {
    point.normal_told = false;
    point.normal = Vector3d::Zero();
    for (const auto& near : index.nearest(point.position, kNeighbours))
      point.normal += told[near.index].normal;
    point.normal.normalize();
  }
  return bare;
}

}  // namespace instep::test
