#include "core/surface/heights/height_base.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace instep {
namespace {

constexpr double kMostBent = 0.7;
/// Less than this is flat.
constexpr double kLeastBent = 1e-3;
/// Cosine to the direction over the plane below which a normal is taken as one of that steepness.
constexpr double kSteepest = 0.25;

}  // namespace

Eigen::Matrix3d axes_over(const Eigen::Vector3d& outward) {
  Eigen::Matrix3d axes;
  axes.row(0) = outward.unitOrthogonal();
  axes.row(1) = outward.cross(axes.row(0));
  axes.row(2) = outward;
  return axes;
}

HeightBase::HeightBase(const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre, double radius)
    : axes_(axes), centre_(centre), radius_(radius) {}

HeightBase HeightBase::bent(double bend) const {
  HeightBase base = *this;
  base.bend_ = std::abs(bend) < kLeastBent ? 0.0 : std::clamp(bend, -kMostBent, kMostBent);
  return base;
}

HeightBase::Spot HeightBase::see(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d local = axes_ * (position - centre_) / radius_;
  if (is_plane()) return {local.head<2>(), local.z()};
  // Seen from the cylinder's axis, which lies inside the body or, where it is hollow, outside.
  const double bend_radius = 1.0 / bend_;
  const double side = bend_ < 0.0 ? -1.0 : 1.0;
  const double out = local.z() + bend_radius;
  const double away = std::hypot(local.x(), out);
  const double sine = side * local.x() / away;
  const double cosine = side * out / away;
  return {{bend_radius * std::atan2(sine, cosine), local.y()},
          side * away - bend_radius,
          cosine,
          sine,
          side * away * bend_};
}

Eigen::Vector2d HeightBase::slope_of(const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d local = axes_ * normal;
  return -local.head<2>() / std::max(local.z(), kSteepest);
}

Eigen::Vector3d HeightBase::gradient(const Eigen::Vector2d& slope, const Spot& spot) const {
  const double round = slope.x() / spot.stretch;
  const Eigen::Vector3d local(spot.sine - round * spot.cosine, -slope.y(),
                              spot.cosine + round * spot.sine);
  return axes_.transpose() * local;
}

}  // namespace instep
