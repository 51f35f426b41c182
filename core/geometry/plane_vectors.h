#pragma once

#include <Eigen/Core>
#include <cmath>

namespace instep {

/// Twice the area of the triangle that two directions span, positive if `b` lies to the left of
/// `a`.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The angle (radians, within half a turn) from `a` to `b`, positive to the left.
inline double turn_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

}  // namespace instep
