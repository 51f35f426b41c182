#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/moments.h"

namespace instep {

/// A plane through the middle of some points.
struct FittedPlane {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, of either sign; zero of none

  /// Over it, to the side of its normal.
  double height(const Eigen::Vector3d& place) const { return normal.dot(place - middle); }
  /// From it, to either side.
  double distance(const Eigen::Vector3d& place) const { return std::abs(height(place)); }

  /// The same, its normal turned to where a direction points.
  FittedPlane facing(const Eigen::Vector3d& direction) const {
    return {middle, normal.dot(direction) < 0.0 ? Eigen::Vector3d(-normal) : normal};
  }
};

/// By least squares, square to the direction in which the points spread least: at least one, whose
/// moments these are round `origin`.
inline FittedPlane plane_of(const Moments& moments, const Eigen::Vector3d& origin) {
  return {origin + moments.middle(), moments.flattest()};
}

}  // namespace instep
