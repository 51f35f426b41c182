#include "sim/solids/round_cone.h"

#include <cmath>

namespace instep {

RoundCone::RoundCone(const Eigen::Vector3d& from, double from_radius, const Eigen::Vector3d& to,
                     double to_radius)
    : from_(from), from_radius_(from_radius), to_radius_(to_radius) {
  const double length = (to - from).norm();
  if (length <= std::abs(from_radius - to_radius)) {
    if (to_radius > from_radius) from_ = to;
    from_radius_ = to_radius_ = std::max(from_radius, to_radius);
    return;
  }
  axis_ = (to - from) / length;
  length_ = length;
  taper_sine_ = (from_radius - to_radius) / length;
  taper_cosine_ = std::sqrt(1.0 - taper_sine_ * taper_sine_);
}

double RoundCone::distance(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - from_;
  const double along = offset.dot(axis_);
  const double across_squared = std::max(0.0, offset.squaredNorm() - along * along);
  const double across = std::sqrt(across_squared);
  const double side = along * taper_cosine_ - across * taper_sine_;
  if (side <= 0.0) return std::sqrt(across_squared + along * along) - from_radius_;
  if (side >= taper_cosine_ * length_) {
    const double beyond = along - length_;
    return std::sqrt(across_squared + beyond * beyond) - to_radius_;
  }
  return across * taper_cosine_ + along * taper_sine_ - from_radius_;
}

double RoundCone::distance(const Eigen::Vector3d& point, Eigen::Vector3d& slope) const {
  const Eigen::Vector3d offset = point - from_;
  const double along = offset.dot(axis_);
  const Eigen::Vector3d across = offset - along * axis_;
  const double side = along * taper_cosine_ - across.norm() * taper_sine_;
  if (side <= 0.0) {
    slope = offset.normalized();
  } else if (side >= taper_cosine_ * length_) {
    slope = (offset - length_ * axis_).normalized();
  } else {
    slope = taper_cosine_ * across.normalized() + taper_sine_ * axis_;
  }
  return distance(point);
}

void RoundCone::extend(Eigen::Vector3d& lowest, Eigen::Vector3d& highest) const {
  const Eigen::Vector3d to = from_ + length_ * axis_;
  lowest = lowest.cwiseMin((from_.array() - from_radius_).matrix())
               .cwiseMin((to.array() - to_radius_).matrix());
  highest = highest.cwiseMax((from_.array() + from_radius_).matrix())
                .cwiseMax((to.array() + to_radius_).matrix());
}

}  // namespace instep
