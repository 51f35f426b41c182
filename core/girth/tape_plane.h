#pragma once

#include <Eigen/Core>
#include <array>

#include "core/geometry/rigid_transform.h"
#include "core/result.h"

namespace instep {

/// The plane in which a tape lies, given by three control points (the paper's c1, c2, c3, section
/// 2.1), with a right-handed frame on it: u and v in the plane, `normal` = u x v.
///
/// The frame's origin is the first control point, u runs towards the second. The three points are
/// kept, since a result names them. Millimetres. An immutable value.
class TapePlane {
 public:
  /// Fails with kInvalidInput if a coordinate is not finite or exceeds kLargestCoordinateMm, or if
  /// the point nearest to the line through the two others is nearer than a hundredth of the longest
  /// distance between two: it hardly tells how the plane is turned round that line.
  static Result<TapePlane> through(const Eigen::Vector3d& c1, const Eigen::Vector3d& c2,
                                   const Eigen::Vector3d& c3);

  const std::array<Eigen::Vector3d, 3>& control_points() const { return control_points_; }
  const Eigen::Vector3d& origin() const { return control_points_[0]; }
  const Eigen::Vector3d& u() const { return u_; }
  const Eigen::Vector3d& v() const { return v_; }
  const Eigen::Vector3d& normal() const { return normal_; }

  /// Signed distance, positive on the side of `normal`.
  double distance(const Eigen::Vector3d& point) const { return normal_.dot(point - origin()); }

  /// Foot of the perpendicular in the plane's own coordinates.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d offset = point - origin();
    return {u_.dot(offset), v_.dot(offset)};
  }

  /// The point in space of in-plane coordinates.
  Eigen::Vector3d lift(const Eigen::Vector2d& in_plane) const {
    return origin() + in_plane.x() * u_ + in_plane.y() * v_;
  }

  /// The same plane and points, with u and v turned about the normal, from u towards v.
  TapePlane turned(double radians) const;

  /// The same plane seen from another frame.
  TapePlane transformed(const RigidTransform& target_from_source) const;

 private:
  TapePlane() = default;

  std::array<Eigen::Vector3d, 3> control_points_;
  Eigen::Vector3d u_;
  Eigen::Vector3d v_;
  Eigen::Vector3d normal_;
};

}  // namespace instep
