#include "sim/solids/cylinder_solid.h"

#include <algorithm>
#include <cmath>

namespace instep {

double CylinderSolid::value(const Eigen::Vector3d& point) const {
  const double outside_wall = std::hypot(point.x(), point.y()) - radius_;
  const double outside_ends = std::max(-point.z(), point.z() - height_);
  return std::min(std::max(outside_wall, outside_ends), 0.0) +
         std::hypot(std::max(outside_wall, 0.0), std::max(outside_ends, 0.0));
}

Eigen::AlignedBox3d CylinderSolid::bounds() const {
  return {Eigen::Vector3d(-radius_, -radius_, 0.0), Eigen::Vector3d(radius_, radius_, height_)};
}

}  // namespace instep
