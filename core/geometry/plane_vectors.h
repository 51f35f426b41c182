#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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

/// In which of `count` > 0 equal sectors round the origin a direction of any length lies, from 0 to
/// below `count`. The first begins where x points backwards, and they follow each other to the
/// left: of four sectors 2 is that of positive coordinates.
inline std::size_t sector_of(const Eigen::Vector2d& direction, std::size_t count) {
  const double turn = std::atan2(direction.y(), direction.x()) / (2.0 * std::numbers::pi) + 0.5;
  const auto sector = static_cast<std::size_t>(turn * static_cast<double>(count));
  return std::min(sector, count - 1);  // straight backwards the turn is whole
}

}  // namespace instep
