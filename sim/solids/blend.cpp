#include "sim/solids/blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace instep {
namespace {

/// A cone this many softnesses further than the nearest one adds less than 1e-9 of a softness.
constexpr double kNegligible = 20.0;

}  // namespace

double Blend::value(const Eigen::Vector3d& point) const {
  constexpr std::size_t kMost = 64;
  std::array<double, kMost> distances;
  const std::size_t count = std::min(cones_.size(), kMost);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    distances[i] = cones_[i].distance(point);
    nearest = std::min(nearest, distances[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double further = (distances[i] - nearest) / softness_;
    if (further < kNegligible) sum += std::exp(-further);
  }
  return nearest - softness_ * std::log(sum);
}

Eigen::AlignedBox3d Blend::bounds() const {
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d highest = -lowest;
  for (const RoundCone& cone : cones_) cone.extend(lowest, highest);
  const double fill = softness_ * std::log(static_cast<double>(cones_.size()));
  return {(lowest.array() - fill).matrix(), (highest.array() + fill).matrix()};
}

double soft_minimum(double a, double b, double softness) {
  const double nearest = std::min(a, b);
  const double further = std::abs(a - b) / softness;
  return further < kNegligible ? nearest - softness * std::log1p(std::exp(-further)) : nearest;
}

double rounded_maximum(double a, double b, double radius) {
  const double over_a = std::max(a + radius, 0.0);
  const double over_b = std::max(b + radius, 0.0);
  return std::min(std::max(a, b), -radius) + std::hypot(over_a, over_b);
}

}  // namespace instep
