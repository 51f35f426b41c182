#pragma once

#include <Eigen/Core>

namespace instep {

/// Value and gradient of a field at one place.
struct FieldValue {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// A point of a surface with a unit normal that points out of the body, and how far it may lie
/// from the true surface (variance along the normal).
struct OrientedPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double variance = 0.0;
};

}  // namespace instep
