#include "tests/support/piled_ring.h"

#include <cmath>
#include <numbers>

namespace instep::test {
namespace {

constexpr double kDirection = 0.5;

}  // namespace

PiledRing::PiledRing(double density, std::uint64_t seed) : random_(seed) {
  add(density, std::numbers::pi, 0.0);
}

void PiledRing::add(double density, double half_angle, double sigma) {
  const auto count = std::lround(density * 2.0 * half_angle * kRadius * kHeight);
  for (long i = 0; i < count; ++i) {
    const double angle = kDirection + random_.uniform(-half_angle, half_angle);
    const double radius = kRadius + sigma * random_.normal();
    points_.emplace_back(middle().x() + radius * std::cos(angle),
                         middle().y() + radius * std::sin(angle),
                         random_.uniform(-0.5, 0.5) * kHeight);
  }
}

double PiledRing::beside(const Eigen::Vector3d& place) {
  const Eigen::Vector2d arm = place.head<2>() - middle();
  return std::abs(
      std::remainder(std::atan2(arm.y(), arm.x()) - kDirection, 2.0 * std::numbers::pi));
}

double PiledRing::off(const Eigen::Vector3d& place) {
  return (place.head<2>() - middle()).norm() - kRadius;
}

}  // namespace instep::test
