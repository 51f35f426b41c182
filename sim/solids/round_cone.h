#pragma once

#include <Eigen/Core>

namespace instep {

/// The hull of two balls: the shape of a bone with its flesh. A ball itself where both ends
/// coincide.
class RoundCone {
 public:
  /// Radii in millimetres, > 0. If one ball lies inside the other, the larger ball is meant.
  RoundCone(const Eigen::Vector3d& from, double from_radius, const Eigen::Vector3d& to,
            double to_radius);

  /// Signed distance to the skin: exact outside, and inside up to the medial axis.
  double distance(const Eigen::Vector3d& point) const;

  /// The same, with the slope of the distance: a unit vector (any, on the axis).
  double distance(const Eigen::Vector3d& point, Eigen::Vector3d& slope) const;

  void extend(Eigen::Vector3d& lowest, Eigen::Vector3d& highest) const;

 private:
  Eigen::Vector3d from_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();  ///< unit, from the first ball to the second
  double length_ = 0.0;
  double from_radius_;
  double to_radius_;
  double taper_sine_ = 0.0;  ///< of the angle between the skin and the axis
  double taper_cosine_ = 1.0;
};

}  // namespace instep
