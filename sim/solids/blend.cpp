#include "sim/solids/blend.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace instep {
namespace {

/// A cone this many softnesses further than the nearest one adds less than 1e-9 of a softness.
constexpr double kNegligible = 20.0;

}  // namespace

void Blend::add(const RoundCone& cone) {
  assert(cones_.size() < kMostCones);
  cones_.push_back(cone);
}

double Blend::value(const Eigen::Vector3d& point) const {
  std::array<double, kMostCones> distances;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    distances[i] = cones_[i].distance(point);
    nearest = std::min(nearest, distances[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const double further = (distances[i] - nearest) / softness_;
    if (further < kNegligible) sum += std::exp(-further);
  }
  return nearest - softness_ * std::log(sum);
}

double Blend::value(const Eigen::Vector3d& point, Eigen::Vector3d& slope) const {
  const double blended = value(point);
  slope.setZero();
  for (const RoundCone& cone : cones_) {
    Eigen::Vector3d own;
    const double further = (cone.distance(point, own) - blended) / softness_;
    if (further < kNegligible) slope += std::exp(-further) * own;
  }
  return blended;
}

Eigen::AlignedBox3d Blend::bounds() const {
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d highest = -lowest;
  for (const RoundCone& cone : cones_) cone.extend(lowest, highest);
  const double fill = softness_ * std::log(static_cast<double>(cones_.size()));
  return {(lowest.array() - fill).matrix(), (highest.array() + fill).matrix()};
}

double soft_minimum(double a, double b, double softness, double& share) {
  const double of_a = std::exp(-std::max(0.0, a - b) / softness);
  const double of_b = std::exp(-std::max(0.0, b - a) / softness);
  share = of_a / (of_a + of_b);
  return std::min(a, b) - softness * std::log(of_a + of_b);
}

double rounded_maximum(double a, double b, double radius, Eigen::Vector2d& shares) {
  const Eigen::Vector2d over(std::max(a + radius, 0.0), std::max(b + radius, 0.0));
  const double length = over.norm();
  shares = length > 0.0 ? Eigen::Vector2d(over / length)
                        : Eigen::Vector2d(a > b ? 1.0 : 0.0, a > b ? 0.0 : 1.0);
  return std::min(std::max(a, b), -radius) + length;
}

}  // namespace instep
