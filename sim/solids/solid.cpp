#include "sim/solids/solid.h"

namespace instep {

Eigen::Vector3d Solid::gradient(const Eigen::Vector3d& point) const {
  constexpr double kStepMm = 1e-4;
  Eigen::Vector3d slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStepMm * Eigen::Vector3d::Unit(axis);
    slope[axis] = (value(point + step) - value(point - step)) / (2.0 * kStepMm);
  }
  return slope;
}

}  // namespace instep
